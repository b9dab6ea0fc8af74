// Compares two pictures of a scene: shows one of them, both with a divider that follows the mouse, both in turn, or their
// difference. The wheel zooms at the mouse; a double click shows the whole picture. Hovering a thumbnail shows its picture;
// a click selects it as the first of the two.
for (const box of document.querySelectorAll('.compare')) {
  const images = [...box.querySelectorAll('.pictures img')], canvas = box.querySelector('canvas');
  const [first, second] = box.querySelectorAll('select'), text = box.querySelector('output');
  const gain = box.querySelector('input[type=range]');
  const width = +images[0].getAttribute('width'), height = +images[0].getAttribute('height');
  const scale = 2 ** +box.dataset.exposure;
  let mode = 'wipe', pointed = null, wipe = 0.5, zoom = 1, left = 0, top = 0, odd = false, pixels = [], differences = {};
  canvas.width = Math.max(width, Math.min(960, Math.round(640 * width / height))); // enlarges small pictures
  canvas.height = Math.round(canvas.width * height / width);
  const draw = canvas.getContext('2d');

  function bytes(index) { // returns the sRGB bytes of a picture
    if (!pixels[index]) {
      const copy = new OffscreenCanvas(width, height).getContext('2d');
      copy.drawImage(images[index], 0, 0);
      pixels[index] = copy.getImageData(0, 0, width, height).data;
    }
    return pixels[index];
  }
  const linear = byte => { const c = byte / 255; return c <= 0.04045 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4; };
  const luminance = (data, at) => 0.2126 * linear(data[at]) + 0.7152 * linear(data[at + 1]) + 0.0722 * linear(data[at + 2]);

  function difference() { // orange: the first picture is brighter; blue: the second is
    const key = first.value + ' ' + second.value + ' ' + gain.value;
    if (!differences[key]) {
      const a = bytes(+first.value), b = bytes(+second.value), image = new ImageData(width, height);
      for (let at = 0; at < a.length; at += 4) {
        const d = Math.max(-1, Math.min(1, 2 ** gain.value * (luminance(a, at) - luminance(b, at))));
        const share = Math.abs(d) ** (1 / 2.2);
        const colour = d > 0 ? [255, 150, 40] : [60, 140, 255];
        for (let c = 0; c < 3; ++c) image.data[at + c] = share * colour[c];
        image.data[at + 3] = 255;
      }
      const copy = new OffscreenCanvas(width, height);
      copy.getContext('2d').putImageData(image, 0, 0);
      differences = {[key]: copy};
    }
    return differences[key];
  }
  function show() {
    const k = zoom * canvas.width / width;
    draw.setTransform(1, 0, 0, 1, 0, 0);
    draw.clearRect(0, 0, canvas.width, canvas.height);
    draw.imageSmoothingEnabled = k < 1;
    draw.setTransform(k, 0, 0, k, -left * k, -top * k);
    for (const [index, image] of images.entries())
      image.parentElement.classList.toggle('on', index === +first.value);
    if (pointed) return draw.drawImage(pointed, 0, 0);
    const a = images[first.value], b = images[second.value];
    if (mode === 'difference') draw.drawImage(difference(), 0, 0);
    else draw.drawImage(mode === 'second' || (mode === 'flicker' && odd) ? b : a, 0, 0);
    if (mode !== 'wipe') return;
    const x = left + wipe * width / zoom;
    draw.save();
    draw.beginPath();
    draw.rect(x, 0, width, height);
    draw.clip();
    draw.drawImage(b, 0, 0);
    draw.restore();
    draw.fillStyle = '#fff';
    draw.fillRect(x - 0.75 / k, 0, 1.5 / k, height);
  }
  const value = (data, at) => [0, 1, 2].map(c => data[at + c] === 255 ? '≥ ' + (1 / scale).toPrecision(2)
                                                                     : (linear(data[at + c]) / scale).toPrecision(2));
  canvas.onmousemove = event => {
    const share = [event.offsetX / canvas.clientWidth, event.offsetY / canvas.clientHeight];
    wipe = share[0];
    const x = Math.floor(left + share[0] * width / zoom), y = Math.floor(top + share[1] * height / zoom);
    if (x >= 0 && y >= 0 && x < width && y < height) {
      const at = 4 * (y * width + x), name = index => images[index].alt + ' ' + value(bytes(index), at).join(' ');
      text.textContent = `(${x}, ${y})   ${name(+first.value)}   |   ${name(+second.value)}`;
    }
    if (mode === 'wipe') show();
  };
  canvas.onwheel = event => {
    event.preventDefault();
    const share = [event.offsetX / canvas.clientWidth, event.offsetY / canvas.clientHeight];
    const next = Math.max(1, Math.min(32, zoom * (event.deltaY < 0 ? 1.25 : 0.8)));
    left = Math.max(0, Math.min(width - width / next, left + share[0] * width * (1 / zoom - 1 / next)));
    top = Math.max(0, Math.min(height - height / next, top + share[1] * height * (1 / zoom - 1 / next)));
    zoom = next;
    show();
  };
  canvas.ondblclick = () => { zoom = 1; left = top = 0; show(); };
  for (const button of box.querySelectorAll('button'))
    button.onclick = () => {
      mode = button.value;
      for (const other of box.querySelectorAll('button')) other.classList.toggle('on', other === button);
      show();
    };
  for (const [index, image] of images.entries()) {
    const small = image.parentElement;
    small.onmouseenter = () => { pointed = image; show(); };
    small.onmouseleave = () => { pointed = null; show(); };
    small.onclick = () => { pointed = null; first.value = index; show(); };
  }
  first.onchange = second.onchange = gain.oninput = show;
  setInterval(() => { if (mode === 'flicker') { odd = !odd; show(); } }, 500);
  Promise.all(images.map(image => image.decode())).then(show);
}
