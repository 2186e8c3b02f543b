
// Two pictures of one place under a divider that is dragged, and their error maps. A wheel over any of them zooms all,
// a drag of a map moves all, and a ring shows the place under the pointer in each.
class PictureView {
  // `pictures`: two of { src, name }; `maps`: any number of { src, name }.
  constructor(parent, pictures, maps) {
    parent.replaceChildren();
    this.zoom = 1;
    this.x = this.y = 0; // of the left upper corner, in shares of the picture
    this.images = [];
    this.rings = [];
    const panes = make(parent, 'div', { class: 'panes' });
    const [before, after] = pictures;
    const slider = this.pane(panes, 'pane slider', [before, after], `left: ${before.name}; right: ${after.name}`);
    this.before = slider.firstChild;
    this.after = slider.children[1];
    this.divider = make(slider, 'div', { class: 'divider' });
    for (const map of maps) this.pane(panes, 'pane map', [map], map.name);
    const bar = make(parent, 'div', { class: 'bar' });
    this.range = make(make(bar, 'label', {}, 'divider '), 'input', { type: 'range', min: 0, max: 100, step: 0.5, value: 50, class: 'position' });
    this.range.addEventListener('input', () => this.divide(this.range.value / 100));
    make_button(bar, '+', () => this.zoom_about(2, 0.5, 0.5));
    make_button(bar, '−', () => this.zoom_about(0.5, 0.5, 0.5));
    make_button(bar, 'whole picture', () => this.reset());
    this.told = make(bar, 'small', { class: 'zoom' });
    make(bar, 'small', {}, ' Drag the divider; the wheel zooms; a drag with Shift, or of a map, moves.');
    this.divide(0.5);
    this.reset();
  }

  pane(parent, look, pictures, caption) {
    const pane = make(parent, 'figure', { class: look });
    const frame = make(pane, 'div', { class: 'frame' });
    for (const { src, name } of pictures) {
      const image = make(make(frame, 'div', { class: 'layer' }), 'img', { src, alt: name });
      const shape = () => {
        if (!image.naturalWidth) return;
        frame.style.aspectRatio = `${image.naturalWidth} / ${image.naturalHeight}`;
        pane.style.maxWidth = `calc(70vh * ${image.naturalWidth / image.naturalHeight})`; // all of it is seen at once
      };
      image.addEventListener('load', shape);
      shape();
      this.images.push(image);
    }
    const ring = make(frame, 'div', { class: 'cross', hidden: '' });
    this.rings.push(ring);
    make(pane, 'figcaption', {}, caption);
    const place = (event) => {
      const box = frame.getBoundingClientRect();
      return [(event.clientX - box.left) / box.width, (event.clientY - box.top) / box.height];
    };
    let from = null;
    const divides = look.includes('slider');
    frame.addEventListener('wheel', (event) => {
      event.preventDefault();
      this.zoom_about(2 ** (-event.deltaY / 240), ...place(event));
    }, { passive: false });
    frame.addEventListener('dblclick', () => this.reset());
    frame.addEventListener('pointerdown', (event) => {
      frame.setPointerCapture(event.pointerId);
      from = place(event);
      if (divides && !event.shiftKey) this.divide(from[0]);
    });
    frame.addEventListener('pointermove', (event) => {
      const at = place(event);
      this.point(at, ring);
      if (!from) return;
      if (divides && !event.shiftKey) this.divide(at[0]);
      else this.move((from[0] - at[0]) / this.zoom, (from[1] - at[1]) / this.zoom);
      from = at;
    });
    for (const name of ['pointerup', 'pointercancel']) frame.addEventListener(name, () => { from = null; });
    frame.addEventListener('pointerleave', () => this.point(null));
    return frame;
  }

  point(at, own) {
    for (const ring of this.rings) {
      ring.hidden = !at || ring === own;
      if (at) Object.assign(ring.style, { left: 100 * at[0] + '%', top: 100 * at[1] + '%' });
    }
  }

  divide(share) {
    this.share = Math.min(Math.max(share, 0), 1);
    this.after.style.clipPath = `inset(0 0 0 ${100 * this.share}%)`;
    this.divider.style.left = 100 * this.share + '%';
    this.range.value = 100 * this.share;
  }

  zoom_about(factor, x, y) {
    const zoom = Math.min(Math.max(this.zoom * factor, 1), 64);
    this.x += x / this.zoom - x / zoom;
    this.y += y / this.zoom - y / zoom;
    this.zoom = zoom;
    this.move(0, 0);
  }

  move(x, y) {
    const most = 1 - 1 / this.zoom;
    this.x = Math.min(Math.max(this.x + x, 0), most);
    this.y = Math.min(Math.max(this.y + y, 0), most);
    const transform = `translate(${-100 * this.x * this.zoom}%, ${-100 * this.y * this.zoom}%) scale(${this.zoom})`;
    for (const image of this.images) image.style.transform = transform;
    this.told.textContent = ` ${this.zoom.toFixed(1)} ×`;
  }

  reset() {
    this.zoom = 1;
    this.move(0, 0);
  }
}

// Pictures that stand side by side in the page become such a view: the first two are compared, the others are maps.
for (const group of document.querySelectorAll('.compared')) {
  const shown = [...group.querySelectorAll('figure')].map((figure) => ({ src: figure.querySelector('img').src, name: figure.querySelector('figcaption').textContent }));
  group.classList.remove('pictures');
  new PictureView(group, shown.slice(0, 2), shown.slice(2));
}
