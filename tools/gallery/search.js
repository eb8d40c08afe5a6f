// Searches the sections of all documents and the names of the core: every word has to occur.
'use strict';
const input = document.getElementById('search');
const found = document.getElementById('found');
const most = 30;

// Sections with all words; those that have more of them in the title first.
function search(words) {
  const hits = [];
  for (const [title, address, text] of sections) {
    const heading = title.toLowerCase();
    const all = `${heading} ${text.toLowerCase()}`;
    if (words.every(word => all.includes(word))) {
      hits.push({ title, address, text, rank: words.filter(word => heading.includes(word)).length });
    }
  }
  return hits.sort((a, b) => b.rank - a.rank).slice(0, most);
}

function extract(text, word) {
  const at = Math.max(0, text.toLowerCase().indexOf(word));
  const begin = Math.max(0, at - 40);
  return (begin > 0 ? '… ' : '') + text.slice(begin, at + 100);
}

function show() {
  const words = input.value.toLowerCase().split(/\s+/).filter(Boolean);
  const hits = words.length > 0 ? search(words) : [];
  found.replaceChildren(...hits.map(hit => {
    const link = document.createElement('a');
    link.href = document.body.dataset.root + hit.address;
    link.textContent = hit.title;
    const item = document.createElement('li');
    item.append(link, ` ${hit.address.split('#')[0]}`, document.createElement('br'),
      extract(hit.text, words[0]));
    return item;
  }));
  if (words.length > 0 && hits.length === 0) {
    found.textContent = 'Nothing found.';
  }
  found.hidden = words.length === 0;
}

input.addEventListener('input', show);
