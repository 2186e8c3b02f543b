
// A scatter with logarithmic axes. The wheel zooms about the pointer, a drag zooms to what it frames, a double click
// shows all. A mark is { x, y, group, title, full, line, item }: `group` gives it colour and shape, `full` marks of a
// `line` are joined by steps, `item` is told when it is pointed at or clicked.
const colours = ['#0072b2', '#d55e00', '#009e73', '#cc79a7', '#e69f00', '#56b4e9', '#000000', '#8a8a00'];
const dashes = ['5 4', '1 3', '10 3', '10 3 1 3', '6 2 1 2 1 2'];

function number_text(value, share) {
  if (value === null || value === undefined || Number.isNaN(value)) return '–';
  return share ? Number((100 * value).toPrecision(3)) + ' %' : Number(value.toPrecision(3)).toString();
}

// Places of an axis from 10^low to 10^high that deserve a line: 1, 2 and 5 of each decade, or finer steps within one.
function ticks_of(low, high) {
  const ticks = [];
  for (let decade = Math.floor(low); decade <= Math.ceil(high); ++decade)
    for (const step of high - low > 4 ? [1] : [1, 2, 5]) ticks.push(step * 10 ** decade);
  const inside = (list) => list.filter((v) => Math.log10(v) >= low && Math.log10(v) <= high);
  if (inside(ticks).length >= 4) return inside(ticks);
  const from = 10 ** low, wide = 10 ** high - from;
  const least = wide / 7, decade = 10 ** Math.floor(Math.log10(least));
  const step = [1, 2, 5, 10].map((s) => s * decade).find((s) => s >= least);
  const fine = [];
  for (let i = Math.ceil(from / step); i * step <= from + wide; ++i) fine.push(Number((i * step).toPrecision(12)));
  return fine;
}

// Those that no other of their line beats in both, the first of equals among them.
function front_of(scores) {
  const front = new Set();
  for (const line of new Set(scores.map((s) => s.line))) {
    let least = Infinity, place = null;
    for (const s of scores.filter((one) => one.line === line).sort((p, q) => p.x - q.x || p.y - q.y)) {
      if (s.y < least || (s.y === least && s.x === place)) front.add(s);
      if (s.y < least) [least, place] = [s.y, s.x];
    }
  }
  return front;
}

function draw_mark(parent, index, x, y, full, small) {
  const colour = colours[index % colours.length];
  const look = { fill: colour, 'fill-opacity': full ? 1 : 0.3, stroke: colour, class: 'point' };
  const r = (full ? 6 : 4.5) * (small ? 0.8 : 1), shape = Math.floor(index / colours.length) % 3;
  if (shape === 0) return make(parent, 'circle', { cx: x, cy: y, r, ...look });
  if (shape === 1) return make(parent, 'rect', { x: x - r, y: y - r, width: 2 * r, height: 2 * r, ...look });
  return make(parent, 'path', { d: `M${x} ${y - 1.3 * r} l${1.3 * r} ${2.3 * r} h${-2.6 * r} z`, ...look });
}

class Plot {
  constructor(parent, { hover, choose }) {
    parent.replaceChildren();
    Object.assign(this, { hover, choose, left: 64, top: 12, wide: 560, high: 360, marks: [], picked: new Map(), pointed: null });
    this.svg = make(parent, 'svg', { class: 'scatter', viewBox: '0 0 800 420', role: 'img' });
    this.reset_button = make_button(make(parent, 'div', { class: 'bar' }), 'show all', () => this.reset());
    make(this.reset_button.parentNode, 'small', {}, ' Point at a mark to see it; click marks to compare them; drag a frame or turn the wheel to zoom.');
    this.start = null;
    this.svg.addEventListener('wheel', (event) => {
      event.preventDefault();
      this.zoom_about(2 ** (event.deltaY / 240), this.share_at(event));
    }, { passive: false });
    this.svg.addEventListener('pointerdown', (event) => {
      if (event.button !== 0 || event.target.closest('.point')) return;
      this.start = this.share_at(event);
      this.svg.setPointerCapture(event.pointerId);
    });
    this.svg.addEventListener('pointermove', (event) => this.frame(event));
    this.svg.addEventListener('pointerup', (event) => this.zoom_to_frame(event));
    this.svg.addEventListener('dblclick', (event) => { if (!event.target.closest('.point')) this.reset(); });
  }

  // Where an event is, in shares of the axes from the lower left corner.
  share_at(event) {
    const box = this.svg.getBoundingClientRect(), scale = 800 / box.width;
    const x = ((event.clientX - box.left) * scale - this.left) / this.wide;
    const y = 1 - ((event.clientY - box.top) * scale - this.top) / this.high;
    return [x, y].map((v) => Math.min(Math.max(v, 0), 1));
  }

  show(marks, titles) {
    this.marks = marks;
    this.titles = titles;
    this.groups = [...new Set(marks.map((m) => m.group))].sort();
    this.reset();
  }

  reset() {
    const range = (values) => {
      const logs = values.filter((v) => v > 0).map(Math.log10);
      if (!logs.length) return [0, 1];
      const low = Math.min(...logs), high = Math.max(...logs), pad = Math.max(0.06 * (high - low), 0.04);
      return [low - pad, high + pad];
    };
    this.all = [range(this.marks.map((m) => m.x)), range(this.marks.map((m) => m.y))];
    this.view = this.all.map((r) => [...r]);
    this.draw();
  }

  zoom_about(factor, at) {
    this.view = this.view.map(([low, high], i) => {
      const wide = Math.max((high - low) * factor, 1e-3);
      if (wide >= this.all[i][1] - this.all[i][0]) return [...this.all[i]];
      const from = low + at[i] * (high - low) - at[i] * wide;
      const kept = Math.min(Math.max(from, this.all[i][0]), this.all[i][1] - wide);
      return [kept, kept + wide];
    });
    this.draw();
  }

  frame(event) {
    if (!this.start) return;
    const at = this.share_at(event);
    if (!this.rectangle) this.rectangle = make(this.svg, 'rect', { class: 'rectangle' });
    const [x, y] = [Math.min(at[0], this.start[0]), Math.max(at[1], this.start[1])];
    for (const [key, value] of [['x', this.left + x * this.wide], ['y', this.top + (1 - y) * this.high],
      ['width', Math.abs(at[0] - this.start[0]) * this.wide], ['height', Math.abs(at[1] - this.start[1]) * this.high]])
      this.rectangle.setAttribute(key, value);
  }

  zoom_to_frame(event) {
    if (!this.start) return;
    const from = this.start, at = this.share_at(event);
    this.start = null;
    if (this.rectangle) this.rectangle.remove();
    this.rectangle = null;
    if (Math.abs(at[0] - from[0]) < 0.02 || Math.abs(at[1] - from[1]) < 0.02) return;
    this.view = this.view.map(([low, high], i) => [Math.min(at[i], from[i]), Math.max(at[i], from[i])].map((v) => low + v * (high - low)));
    this.draw();
  }

  place(axis, value) {
    const [low, high] = this.view[axis];
    const log = value > 0 ? Math.log10(value) : this.all[axis][0]; // what is zero stands at the edge
    const share = (log - low) / (high - low);
    return axis === 0 ? share * this.wide : (1 - share) * this.high;
  }

  draw() {
    const { svg, left, top, wide, high } = this;
    svg.replaceChildren();
    this.nodes = new Map();
    if (!this.marks.length) {
      make(svg, 'text', { x: 40, y: 60 }, 'No point of this choice was measured.');
      return;
    }
    for (const tick of ticks_of(...this.view[0])) {
      const x = left + this.place(0, tick);
      make(svg, 'line', { x1: x, x2: x, y1: top, y2: top + high, stroke: '#e4e4e4' });
      make(svg, 'text', { x, y: top + high + 16, 'text-anchor': 'middle' }, number_text(tick, this.titles.x_share));
    }
    for (const tick of ticks_of(...this.view[1])) {
      const y = top + this.place(1, tick);
      make(svg, 'line', { x1: left, x2: left + wide, y1: y, y2: y, stroke: '#e4e4e4' });
      make(svg, 'text', { x: left - 6, y: y + 4, 'text-anchor': 'end' }, number_text(tick, this.titles.share));
    }
    make(svg, 'text', { x: left + wide / 2, y: top + high + 38, 'text-anchor': 'middle' }, this.titles.x);
    make(svg, 'text', { transform: `translate(14 ${top + high / 2}) rotate(-90)`, 'text-anchor': 'middle' }, this.titles.y);
    const inside = make(svg, 'svg', { x: left, y: top, width: wide, height: high }); // which clips
    this.draw_lines(inside);
    const rank = (mark) => mark.full + 2 * Boolean(mark.label); // what has a name is seen above all
    for (const mark of [...this.marks].sort((p, q) => rank(p) - rank(q))) this.draw_point(inside, mark);
    this.draw_legend();
    this.show_picked();
  }

  draw_lines(inside) {
    [...new Set(this.marks.map((m) => m.line))].sort().forEach((line, i) => {
      const own = this.marks.filter((m) => m.full && m.line === line).sort((p, q) => p.x - q.x || q.y - p.y);
      const steps = own.map((m, k) => (k ? `H${this.place(0, m.x)} V${this.place(1, m.y)}` : `M${this.place(0, m.x)} ${this.place(1, m.y)}`));
      make(inside, 'path', { d: steps.join(' '), fill: 'none', stroke: '#777', 'stroke-dasharray': dashes[i % dashes.length], class: 'front-line' });
    });
  }

  draw_point(inside, mark) {
    const x = this.place(0, mark.x), y = this.place(1, mark.y);
    const node = draw_mark(inside, this.groups.indexOf(mark.group), x, y, mark.full);
    node.setAttribute('tabindex', 0);
    make(node, 'title', {}, mark.title);
    if (mark.label) make(inside, 'text', { x: x + 9, y: y - 6 }, mark.label);
    for (const event of ['mouseenter', 'focus']) node.addEventListener(event, () => this.hover(mark.item));
    on_press(node, () => this.choose(mark.item));
    this.nodes.set(mark.item, { node, x, y, inside });
  }

  draw_legend() {
    const x = this.left + this.wide + 18;
    this.groups.slice(0, 20).forEach((group, i) => {
      draw_mark(this.svg, i, x, this.top + 10 + 17 * i, true, true).setAttribute('class', 'key');
      make(this.svg, 'text', { x: x + 11, y: this.top + 14 + 17 * i }, group);
    });
    let y = this.top + 22 + 17 * Math.min(this.groups.length, 20);
    make(this.svg, 'text', { x: x - 6, y, fill: '#666' }, 'full: on the Pareto front');
    const lines = [...new Set(this.marks.map((m) => m.line))].sort();
    if (lines.length > 1)
      lines.forEach((line, i) => {
        y += 16;
        make(this.svg, 'path', { d: `M${x - 6} ${y - 4} h22`, stroke: '#777', 'stroke-dasharray': dashes[i % dashes.length] });
        make(this.svg, 'text', { x: x + 20, y, fill: '#666' }, line);
      });
  }

  // `picked`: a letter for each chosen item.
  pick(picked) {
    this.picked = picked;
    this.show_picked();
  }

  point_at(item) {
    this.pointed = item;
    this.show_picked();
  }

  show_picked() {
    for (const old of this.svg.querySelectorAll('.letter')) old.remove();
    for (const [item, { node, x, y, inside }] of this.nodes) {
      node.classList.toggle('pointed', item === this.pointed);
      node.classList.toggle('picked', this.picked.has(item));
      if (this.picked.has(item)) make(inside, 'text', { x: x - 4, y: y - 10, class: 'letter', 'font-weight': 'bold' }, this.picked.get(item));
    }
  }
}
