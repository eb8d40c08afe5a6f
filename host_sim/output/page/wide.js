'use strict';

// Boxes that are scrolled sideways: each says so, fades at the side where it goes on, and takes the keyboard.
const markWide = (selector) => {
  const mark = (box) => {
    const hidden = box.scrollWidth - box.clientWidth;
    box.previousElementSibling.hidden = hidden <= 1;
    box.classList.toggle('more-right', hidden > 1 && box.scrollLeft < hidden - 1);
    box.classList.toggle('more-left', hidden > 1 && box.scrollLeft > 1);
    if (hidden > 1) box.tabIndex = 0;
    else box.removeAttribute('tabindex');
  };
  const sizes = new ResizeObserver((entries) => entries.forEach(({target}) => mark(target)));
  for (const box of document.querySelectorAll(selector)) {
    const hint = document.createElement('p');
    hint.className = 'sideways';
    hint.textContent = 'Wider than the page: scroll sideways \u2192';
    box.before(hint);
    box.addEventListener('scroll', () => mark(box), {passive: true});
    sizes.observe(box);
    mark(box);
  }
};
