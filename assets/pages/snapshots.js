
// Two of the snapshots under a divider.
const images = [...document.querySelectorAll('section > img')];

function show_snapshots() {
  const place = make(document.createElement('div'), 'div'), bar = make(place, 'div', { class: 'bar' }), view = make(place, 'div', { id: 'pair' });
  document.querySelector('h1').after(place);
  const names = images.map((image) => image.closest('section').querySelector('h2').textContent);
  const sides = ['left', 'right'].map((side, i) => make_select(bar, side, names.map((name, k) => [k, name]), i, draw));
  function draw() {
    new PictureView(view, sides.map((side) => ({ src: images[side.value].src, name: names[side.value] })), []);
  }
  draw();
}
if (images.length > 1) show_snapshots();
