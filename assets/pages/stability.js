
// A case's curves, large: the one that is pointed at with its values, the mark, and the other graphs' behind them as far
// as they reach into the same range.
function draw_curves(panel, one, graph) {
  const wide = 560, high = 260, left = 16, top = 16;
  make(panel, 'b', {}, `${one.name}: ${graph}`);
  make(panel, 'div', { class: 'hint' }, `${one.quantity}, mark ${one.mark_text}`);
  const svg = make(panel, 'svg', { width: wide, height: high + 60, viewBox: `0 0 ${wide} ${high + 60}` });
  const own = one.curves.find((curve) => curve.graph === graph);
  const values = own.values.concat(one.mark ?? [], 0);
  const low = Math.min(...values), range = Math.max(...values) - low || 1;
  const x = (i) => left + 44 + (wide - 2 * left - 130) * (one.ladder.length > 1 ? i / (one.ladder.length - 1) : 0.5);
  const y = (value) => top + high - 8 - (value - low) / range * (high - 24);
  for (const [value, text, dash] of [[0, '0', ''], [one.mark, 'mark', '4 3']]) {
    if (value === null) continue;
    make(svg, 'line', { x1: left, x2: wide - left, y1: y(value), y2: y(value), stroke: '#999', 'stroke-dasharray': dash });
    make(svg, 'text', { x: left, y: y(value) - 3, fill: '#666' }, text);
  }
  const curve_of = (parent, curve, look) => make(parent, 'polyline', { points: curve.values.map((v, i) => `${x(i)},${y(v)}`).join(' '), fill: 'none', ...look });
  const inside = make(svg, 'svg', { width: wide, height: top + high }); // which clips
  for (const curve of one.curves) {
    if (curve === own || !curve.values.every(Number.isFinite)) continue;
    curve_of(inside, curve, { stroke: '#bbb' });
    const last = curve.values.length - 1;
    make(inside, 'text', { x: x(last) + 5, y: y(curve.values[last]) + 4, fill: '#888' }, curve.graph);
  }
  const colour = own.reached ? '#0072b2' : '#d55e00';
  curve_of(svg, own, { stroke: colour, 'stroke-width': 2.5, class: 'own' });
  own.values.forEach((value, i) => {
    make(svg, 'circle', { cx: x(i), cy: y(value), r: 3.5, fill: colour });
    make(svg, 'text', { x: x(i), y: y(value) - 8, 'text-anchor': 'middle', class: 'value' }, own.texts[i]);
    make(svg, 'text', { x: x(i), y: top + high + 14, 'text-anchor': 'middle' }, String(one.ladder[i]));
  });
  make(svg, 'text', { x: wide / 2, y: top + high + 34, 'text-anchor': 'middle' }, one.step);
}

for (const curve of document.querySelectorAll('svg.curve')) {
  const one = data.cases[curve.closest('tr').dataset.case], graph = data.graphs[curve.closest('td').dataset.graph];
  enlarges(curve, (panel) => draw_curves(panel, one, graph));
}
