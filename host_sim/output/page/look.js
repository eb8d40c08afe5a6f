'use strict';

// How curves and texts look. Colours are variables of the style sheet, so that light, dark and
// print differ there alone.
const Look = (() => {
  const colourCount = 8;  // Okabe and Ito's: apart for every kind of colour vision
  const dashes = ['', '8 4', '2 3', '9 3 2 3', '14 4', '5 2 2 2 2 2', '1 5', '12 3 4 3'];
  const printed = ['', '8 4', '2 3'];  // of the pens' dashes 1 to 3

  const escape = (text) => text.replace(/[&<>"]/g, (c) => `&#${c.charCodeAt(0)};`);

  // A text in which `_` and `^` lower and raise, in parts.
  const parts = (text, verbatim) => {
    if (verbatim) return [{text, shift: 0}];
    return text.split(/([_^](?:\{[^}]*\}|[^\s{]))/).filter((part) => part !== '').map((part) => {
      const shift = part.length > 1 ? {'_': -1, '^': 1}[part[0]] : 0;
      return shift ? {text: part.slice(1).replace(/^\{(.*)\}$/, '$1'), shift} : {text: part, shift: 0};
    });
  };

  const html = (text, verbatim) => parts(text, verbatim).map(({text: part, shift}) => {
    const tag = {'-1': 'sub', '1': 'sup'}[shift];
    return tag ? `<${tag}>${escape(part)}</${tag}>` : escape(part);
  }).join('');

  const svg = (text, verbatim) => parts(text, verbatim).map(({text: part, shift}) => shift ?
      `<tspan dy="${-4 * shift}" font-size="80%">${escape(part)}</tspan><tspan dy="${4 * shift}">\u200b</tspan>` :
      escape(part)).join('');

  const isGrey = (colour) =>
      colour.slice(1, 3) === colour.slice(3, 5) && colour.slice(3, 5) === colour.slice(5, 7);

  // Curves whose pen is given keep what it tells apart: one colour of print is one on the page.
  // The others differ in colour and dash.
  const manyDots = 60;  // smaller, so that a curve over them is seen
  const styles = (series) => {
    const colours = [];
    let free = 0;
    return series.map(({pen, line, y}) => {
      if (!pen) {
        const index = free++;
        return {colour: `var(--series-${index % colourCount})`, dash: dashes[index % dashes.length],
                symbol: line === 'dots' ? 7 + 2 * (index % 4) : 0,
                size: line === 'dots' && y.length > manyDots ? 0.1 : 1, every: 1, width: 1.6};
      }
      let colour = 'var(--ink)';
      if (!isGrey(pen.colour)) {
        if (!colours.includes(pen.colour)) colours.push(pen.colour);
        colour = `var(--series-${colours.indexOf(pen.colour) % colourCount})`;
      } else if (parseInt(pen.colour.slice(1, 3), 16) > 0x40) {
        colour = 'var(--muted)';
      }
      const symbol = line === 'dots' && pen.symbol === 0 ? 7 : pen.symbol;
      return {colour, dash: printed[pen.dash - 1] || '', symbol, size: pen.size, every: pen.every,
              width: Math.min(Math.max(pen.width, 1.2), 2.4)};
    });
  };

  // A marker as a path about a point. Of gnuplot's numbers the odd ones are filled, and the even one
  // below has the same outline.
  const marker = (symbol, x, y, r) => {
    const polygon = (corners, turn) => {
      const points = [];
      for (let i = 0; i < corners; ++i) {
        const angle = turn + 2 * Math.PI * i / corners;
        points.push(`${(x + r * Math.cos(angle)).toFixed(1)} ${(y + r * Math.sin(angle)).toFixed(1)}`);
      }
      return `M${points.join('L')}z`;
    };
    switch (symbol | 1) {
      case 5: return polygon(4, Math.PI / 4);
      case 9: return polygon(3, -Math.PI / 2);
      case 11: return polygon(3, Math.PI / 2);
      case 13: return polygon(4, 0);
      case 15: return polygon(5, -Math.PI / 2);
      default: return `M${(x - r).toFixed(1)} ${y.toFixed(1)}a${r} ${r} 0 1 0 ${2 * r} 0a${r} ${r} 0 1 0 ${-2 * r} 0z`;
    }
  };
  const isFilled = (symbol) => symbol % 2 === 1;
  const radius = (style) => Math.min(Math.max(2 + 2 * style.size, 2.2), 5);

  // Viridis at nine places. Source: Smith and van der Walt, the default map of Matplotlib 2.
  const viridis = ['440154', '472d7b', '3b528b', '2c728e', '21918c', '28ae80', '5ec962', 'addc30', 'fde725']
      .map((hex) => [0, 2, 4].map((i) => parseInt(hex.slice(i, i + 2), 16)));
  // @param part  of the range, 0 to 1
  const heat = (part) => {
    const place = Math.min(Math.max(part, 0), 1) * (viridis.length - 1);
    const i = Math.min(Math.floor(place), viridis.length - 2);
    const mixed = viridis[i].map((low, k) => Math.round(low + (place - i) * (viridis[i + 1][k] - low)));
    return `rgb(${mixed.join(',')})`;
  };

  return {escape, html, svg, styles, marker, isFilled, radius, heat};
})();
