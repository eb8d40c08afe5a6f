'use strict';

// Boxes that are scrolled sideways: each fades at the side where it goes on, and takes the keyboard.
const markWide = (selector) => {
  const mark = (box) => {
    const hidden = box.scrollWidth - box.clientWidth;
    box.classList.toggle('more-right', hidden > 1 && box.scrollLeft < hidden - 1);
    box.classList.toggle('more-left', hidden > 1 && box.scrollLeft > 1);
    if (hidden > 1) box.tabIndex = 0;
    else box.removeAttribute('tabindex');
  };
  const sizes = new ResizeObserver((entries) => entries.forEach(({target}) => mark(target)));
  for (const box of document.querySelectorAll(selector)) {
    box.addEventListener('scroll', () => mark(box), {passive: true});
    sizes.observe(box);
    mark(box);
  }
};
