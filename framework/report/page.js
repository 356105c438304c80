// Draws the fields of the matrix: triangles are filled pixel by pixel, so that values can be read back at the pointer.
'use strict';
(() => {
  const source = document.getElementById('map-data');
  if (!source) return;
  const data = JSON.parse(source.textContent);
  const element = (id) => document.getElementById(id);
  const bytes = (text) => Uint8Array.from(atob(text), (c) => c.charCodeAt(0)).buffer;
  const meshes = data.meshes.map((mesh) => ({
    points: new Float32Array(bytes(mesh.points)),
    cells: new Uint32Array(bytes(mesh.cells)),
  }));
  const unpacked = (texts) => texts.map((text) => new Uint16Array(bytes(text)));
  const values = data.times.map((time) => unpacked(time.values));
  const lineValues = data.times.map((time) => unpacked(time.lineValues));
  const segments = data.times.map((time) => new Float32Array(bytes(time.segments)));
  const fractureOf = data.times.map((time) => new Uint16Array(bytes(time.fracture)));
  const rgb = (text) => [1, 3, 5].map((i) => parseInt(text.slice(i, i + 2), 16));
  const colours = data.colours.map(rgb);
  // Those of fractures (matplotlib's inferno at six places) stand out from those of the rock.
  const lineColours = (() => {
    const anchors = ['#000004', '#420a68', '#932667', '#dd513a', '#fca50a', '#fcffa4'].map(rgb);
    return colours.map((_, i) => {
      const place = i / (colours.length - 1) * (anchors.length - 1);
      const k = Math.min(Math.floor(place), anchors.length - 2);
      return anchors[k].map((a, c) => Math.round(a + (place - k) * (anchors[k + 1][c] - a)));
    });
  })();

  const bounds = (coordinates, box = [Infinity, Infinity, -Infinity, -Infinity]) => {
    for (let i = 0; i < coordinates.length; i += 2) {
      box[0] = Math.min(box[0], coordinates[i]);
      box[1] = Math.min(box[1], coordinates[i + 1]);
      box[2] = Math.max(box[2], coordinates[i]);
      box[3] = Math.max(box[3], coordinates[i + 1]);
    }
    return box;
  };
  const whole = bounds(meshes[0].points);
  const lineBox = () => {
    const lines = data.times[data.times.length - 1].lines;
    if (!lines.length) return whole;
    const box = lines.reduce((all, line) => bounds(line, all), undefined);
    const room = 0.6 * Math.max(box[2] - box[0], box[3] - box[1]);
    return [box[0] - room, box[1] - room, box[2] + room, box[3] + room];
  };

  const state = { field: 0, lineField: -1, time: data.times.length - 1, sameScale: true, box: whole.slice() };

  // Round numbers between low and high, about `count` of them.
  const ticks = (low, high, count) => {
    if (!(high > low)) return [{ value: low, text: String(+low.toPrecision(4)) }];
    const least = (high - low) / count;
    const power = 10 ** Math.floor(Math.log10(least));
    const step = [1, 2, 5, 10].map((f) => f * power).find((s) => s >= least * (1 - 1e-9));
    const decimals = Math.min(Math.max(0, -Math.floor(Math.log10(step) + 1e-9)), 12);
    const found = [];
    for (let i = Math.ceil(low / step - 1e-9); i * step <= high + 1e-9 * step; ++i)
      found.push({ value: i * step, text: (i * step + 0).toFixed(decimals) });
    return found;
  };

  // The range of the colours, in display units.
  const rangeOf = (field, packed) => {
    if (state.sameScale) return [field.low, field.high];
    let low = 65535, high = 0;
    for (const v of packed) {
      if (v < low) low = v;
      if (v > high) high = v;
    }
    const size = (field.high - field.low) / 65535;
    return low > high ? [0, 0] : [field.low + low * size, field.low + high * size];
  };
  const scale = (fieldIndex, timeIndex) => rangeOf(data.fields[fieldIndex], values[timeIndex][fieldIndex]);
  const lineScale = (timeIndex) => rangeOf(data.lineFields[state.lineField], lineValues[timeIndex][state.lineField]);
  const lineValue = (timeIndex, i) => {
    const field = data.lineFields[state.lineField];
    return field.low + lineValues[timeIndex][state.lineField][i] * (field.high - field.low) / 65535;
  };
  const colourAt = (palette, value, range) => {
    const share = range[1] > range[0] ? (value - range[0]) / (range[1] - range[0]) : 0.5;
    return `rgb(${palette[Math.round(Math.min(1, Math.max(0, share)) * (palette.length - 1))].join(',')})`;
  };

  // The value at each pixel of a width × height picture of `box`, NaN outside of the mesh.
  const raster = (fieldIndex, timeIndex, box, width, height) => {
    const { points, cells } = meshes[data.times[timeIndex].mesh];
    const field = data.fields[fieldIndex];
    const packed = values[timeIndex][fieldIndex];
    const size = (field.high - field.low) / 65535;
    const out = new Float32Array(width * height).fill(NaN);
    if (!packed.length) return out;
    const sx = width / (box[2] - box[0]), sy = height / (box[3] - box[1]);
    for (let c = 0; c < cells.length; c += 3) {
      const [a, b, d] = [cells[c], cells[c + 1], cells[c + 2]];
      const ax = (points[2 * a] - box[0]) * sx, ay = (box[3] - points[2 * a + 1]) * sy;
      const bx = (points[2 * b] - box[0]) * sx, by = (box[3] - points[2 * b + 1]) * sy;
      const dx = (points[2 * d] - box[0]) * sx, dy = (box[3] - points[2 * d + 1]) * sy;
      const area = (bx - ax) * (dy - ay) - (dx - ax) * (by - ay);
      if (area === 0) continue;
      const left = Math.max(0, Math.floor(Math.min(ax, bx, dx))), right = Math.min(width - 1, Math.ceil(Math.max(ax, bx, dx)));
      const top = Math.max(0, Math.floor(Math.min(ay, by, dy))), bottom = Math.min(height - 1, Math.ceil(Math.max(ay, by, dy)));
      const va = packed[field.onPoints ? a : c / 3], vb = packed[field.onPoints ? b : c / 3], vd = packed[field.onPoints ? d : c / 3];
      for (let y = top; y <= bottom; ++y) {
        for (let x = left; x <= right; ++x) {
          const px = x + 0.5, py = y + 0.5;
          const wd = ((bx - ax) * (py - ay) - (px - ax) * (by - ay)) / area;
          const wb = ((px - ax) * (dy - ay) - (dx - ax) * (py - ay)) / area;
          if (wd < -1e-6 || wb < -1e-6 || wd + wb > 1 + 1e-6) continue;
          out[y * width + x] = field.low + size * (va + wb * (vb - va) + wd * (vd - va));
        }
      }
    }
    return out;
  };

  const paint = (context, left, top, width, height, pixels, range) => {
    const image = context.createImageData(width, height);
    const factor = range[1] > range[0] ? (colours.length - 1) / (range[1] - range[0]) : 0;
    let painted = 0;
    for (let i = 0; i < pixels.length; ++i) {
      if (Number.isNaN(pixels[i])) continue;
      const index = factor === 0 ? colours.length >> 1 : Math.round((pixels[i] - range[0]) * factor);
      const colour = colours[Math.min(colours.length - 1, Math.max(0, index))];
      image.data[4 * i] = colour[0];
      image.data[4 * i + 1] = colour[1];
      image.data[4 * i + 2] = colour[2];
      image.data[4 * i + 3] = 255;
      ++painted;
    }
    context.putImageData(image, left, top);
    return painted;
  };

  const drawLines = (context, timeIndex, box, left, top, width, height, thickness) => {
    const sx = width / (box[2] - box[0]), sy = height / (box[3] - box[1]);
    context.save();
    context.beginPath();
    context.rect(left, top, width, height);
    context.clip();
    for (const [style, extra] of [['#ffffff', 2], ['#111111', 0]]) {
      context.strokeStyle = style;
      context.lineWidth = thickness + extra;
      context.lineJoin = context.lineCap = 'round';
      for (const line of data.times[timeIndex].lines) {
        context.beginPath();
        for (let i = 0; i < line.length; i += 2)
          context.lineTo(left + (line[i] - box[0]) * sx, top + (box[3] - line[i + 1]) * sy);
        context.stroke();
      }
    }
    if (state.lineField >= 0) {
      const range = lineScale(timeIndex), ends = segments[timeIndex];
      context.lineWidth = 1.6 * thickness;
      for (let i = 0; 4 * i < ends.length; ++i) {
        context.strokeStyle = colourAt(lineColours, lineValue(timeIndex, i), range);
        context.beginPath();
        context.moveTo(left + (ends[4 * i] - box[0]) * sx, top + (box[3] - ends[4 * i + 1]) * sy);
        context.lineTo(left + (ends[4 * i + 2] - box[0]) * sx, top + (box[3] - ends[4 * i + 3]) * sy);
        context.stroke();
      }
    }
    context.restore();
  };

  const canvas = element('map');
  const ratio = 2;  // pixels of the picture for one of the page: sharp on screens and on paper
  const margin = { left: 120, right: 230, top: 20, bottom: 80 };
  const frame = { width: 1650, height: 0 };
  let shown = { pixels: null, box: whole };

  // The box with the shape of the frame.
  const fitted = (box) => {
    const w = box[2] - box[0], h = box[3] - box[1];
    const shape = frame.width / frame.height;
    const [nw, nh] = w / h < shape ? [h * shape, h] : [w, w / shape];
    const cx = (box[0] + box[2]) / 2, cy = (box[1] + box[3]) / 2;
    return [cx - nw / 2, cy - nh / 2, cx + nw / 2, cy + nh / 2];
  };

  const setFrame = () => {
    const shape = (whole[3] - whole[1]) / (whole[2] - whole[0]);
    margin.right = state.lineField >= 0 ? 460 : 230;
    // What is written keeps its size on a narrow screen.
    const padding = 48, room = ratio * (document.querySelector('main').clientWidth - padding) - margin.left - margin.right;
    const widest = Math.min(1650, Math.max(room, 480));
    frame.width = widest;
    frame.height = Math.round(frame.width * shape);
    if (frame.height > 1150) {
      frame.height = 1150;
      frame.width = Math.min(widest, Math.max(700, Math.round(frame.height / shape)));
    }
    frame.height = Math.max(frame.height, 300);
    canvas.width = margin.left + frame.width + margin.right;
    canvas.height = margin.top + frame.height + margin.bottom;
    canvas.style.maxWidth = canvas.width / ratio + 'px';
  };

  const drawAxes = (context, box) => {
    const { left, top } = margin;
    context.textAlign = 'center';
    context.textBaseline = 'top';
    for (const tick of ticks(box[0], box[2], Math.max(2, Math.round(frame.width / 206)))) {
      const x = left + (tick.value - box[0]) / (box[2] - box[0]) * frame.width;
      context.strokeRect(x, top + frame.height, 0, 8);
      context.fillText(tick.text, x, top + frame.height + 12);
    }
    context.fillText('x [m]', left + frame.width / 2, top + frame.height + 44);
    context.textAlign = 'right';
    context.textBaseline = 'middle';
    for (const tick of ticks(box[1], box[3], 6)) {
      const y = top + (box[3] - tick.value) / (box[3] - box[1]) * frame.height;
      context.strokeRect(left - 8, y, 8, 0);
      context.fillText(tick.text, left - 14, y);
    }
    context.save();
    context.translate(22, top + frame.height / 2);
    context.rotate(-Math.PI / 2);
    context.textAlign = 'center';
    context.fillText('y [m]', 0, 0);
    context.restore();
  };

  // Edges of the box around a body, with what they count.
  const drawEdges = (context, box) => {
    const { left, top } = margin;
    const at = (point) => [left + (point[0] - box[0]) / (box[2] - box[0]) * frame.width,
                           top + (box[3] - point[1]) / (box[3] - box[1]) * frame.height];
    const isShown = ([x, y]) => x >= left && x <= left + frame.width && y >= top && y <= top + frame.height;
    const centre = at([(whole[0] + whole[2]) / 2, (whole[1] + whole[3]) / 2]);
    context.textBaseline = 'middle';
    for (const edge of data.edges) {
      const from = at(edge.from), to = at(edge.to);
      const middle = [(from[0] + to[0]) / 2, (from[1] + to[1]) / 2];
      // Out of the body, at right angles to the edge.
      const length = Math.hypot(to[0] - from[0], to[1] - from[1]);
      let out = [(to[1] - from[1]) / length, (from[0] - to[0]) / length];
      if (out[0] * (middle[0] - centre[0]) + out[1] * (middle[1] - centre[1]) < 0) out = [-out[0], -out[1]];
      context.textAlign = out[0] > 0.3 ? 'left' : out[0] < -0.3 ? 'right' : 'center';
      const write = (text, [x, y], distance) => context.fillText(text, x + out[0] * distance, y + out[1] * distance);
      for (const tick of ticks(edge.low, edge.high, Math.min(4, Math.max(1, length / 100)))) {
        const share = (tick.value - edge.low) / (edge.high - edge.low);
        if (edge.name === 'y' && Math.abs(share - 0.5) > 0.48) continue;  // the other edges write at its ends
        const place = [from[0] + share * (to[0] - from[0]), from[1] + share * (to[1] - from[1])];
        if (!isShown(place)) continue;
        context.beginPath();
        context.moveTo(...place);
        context.lineTo(place[0] + out[0] * 8, place[1] + out[1] * 8);
        context.stroke();
        write(tick.text, place, 16);
      }
      if (isShown(middle)) write(edge.name + ' [m]', middle, 62);
    }
  };

  const drawFrame = (context, box, range, field) => {
    const { left, top } = margin;
    context.fillStyle = '#1d2329';
    context.strokeStyle = '#888';
    context.lineWidth = 1.5;
    context.font = 11 * ratio + 'px system-ui, Arial, sans-serif';
    context.strokeRect(left, top, frame.width, frame.height);
    (data.inSpace ? drawEdges : drawAxes)(context, box);
    drawBar(context, left + frame.width + 40, colours, range, field.unit);
    if (state.lineField >= 0)
      drawBar(context, left + frame.width + 270, lineColours, lineScale(state.time), data.lineFields[state.lineField].unit);
  };

  const drawBar = (context, x, palette, range, unit) => {
    const { top } = margin, width = 34, above = 40;
    const height = frame.height - above;
    for (let i = 0; i < height; ++i) {
      const value = range[0] + (1 - i / (height - 1)) * (range[1] - range[0]);
      context.fillStyle = colourAt(palette, value, range);
      context.fillRect(x, top + above + i, width, 1.5);
    }
    context.strokeRect(x, top + above, width, height);
    context.fillStyle = '#1d2329';
    context.textAlign = 'left';
    if (unit) context.fillText(unit, x, top + 16);
    for (const tick of ticks(range[0], range[1], 7)) {
      const share = range[1] > range[0] ? (tick.value - range[0]) / (range[1] - range[0]) : 0.5;
      const y = top + above + (1 - share) * height;
      context.strokeRect(x + width, y, 7, 0);
      context.fillText(tick.text, x + width + 13, y);
    }
  };

  const drawSmall = () => {
    const holder = element('map-small');
    if (data.times.length < 2) return;
    holder.replaceChildren(...data.times.map((time, index) => {
      const figure = document.createElement('figure');
      const small = document.createElement('canvas');
      small.width = 300;
      small.height = Math.max(40, Math.min(600, Math.round(300 * frame.height / frame.width)));
      const context = small.getContext('2d');
      const box = fitted(state.box);
      paint(context, 0, 0, small.width, small.height,
            raster(state.field, index, box, small.width, small.height), scale(state.field, index));
      drawLines(context, index, box, 0, 0, small.width, small.height, 2);
      figure.className = index === state.time ? 'chosen' : '';
      figure.append(small, time.text);
      figure.addEventListener('click', () => { state.time = index; draw(); });
      return figure;
    }));
  };

  const draw = () => {
    const context = canvas.getContext('2d');
    const box = fitted(state.box);
    const field = data.fields[state.field];
    const range = scale(state.field, state.time);
    const pixels = raster(state.field, state.time, box, frame.width, frame.height);
    context.fillStyle = '#ffffff';
    context.fillRect(0, 0, canvas.width, canvas.height);
    canvas.dataset.pixels = paint(context, margin.left, margin.top, frame.width, frame.height, pixels, range);
    canvas.dataset.field = field.label;
    canvas.dataset.lineField = state.lineField < 0 ? '' : data.lineFields[state.lineField].label;
    drawLines(context, state.time, box, margin.left, margin.top, frame.width, frame.height, 3.5);
    drawFrame(context, box, range, field);
    shown = { pixels, box };
    element('map-time').value = state.time;
    element('map-time-text').textContent = data.times[state.time].text;
    drawSmall();
  };

  const place = (event) => {
    const where = canvas.getBoundingClientRect();
    const x = (event.clientX - where.left) * canvas.width / where.width - margin.left;
    const y = (event.clientY - where.top) * canvas.height / where.height - margin.top;
    return [x, y];
  };
  const zoom = (factor) => {
    const [x0, y0, x1, y1] = state.box;
    const cx = (x0 + x1) / 2, cy = (y0 + y1) / 2, w = (x1 - x0) / 2 * factor, h = (y1 - y0) / 2 * factor;
    state.box = [cx - w, cy - h, cx + w, cy + h];
    draw();
  };

  // The cell of a fracture within some pixels of a place in the frame, or -1.
  const segmentAt = (x, y) => {
    const ends = segments[state.time], box = shown.box;
    const sx = frame.width / (box[2] - box[0]), sy = frame.height / (box[3] - box[1]);
    let nearest = 12, found = -1;
    for (let i = 0; 4 * i < ends.length; ++i) {
      const ax = (ends[4 * i] - box[0]) * sx, ay = (box[3] - ends[4 * i + 1]) * sy;
      const dx = (ends[4 * i + 2] - box[0]) * sx - ax, dy = (box[3] - ends[4 * i + 3]) * sy - ay;
      const along = Math.min(1, Math.max(0, ((x - ax) * dx + (y - ay) * dy) / (dx * dx + dy * dy)));
      const away = Math.hypot(x - ax - along * dx, y - ay - along * dy);
      if (away < nearest) [nearest, found] = [away, i];
    }
    return found;
  };
  const fractureText = (x, y) => {
    const i = segmentAt(x, y);
    if (i < 0) return '';
    const name = data.names[fractureOf[state.time][i]];
    if (state.lineField < 0) return `; fracture ${name}`;
    const field = data.lineFields[state.lineField];
    return `; fracture ${name}: ${field.label} = ${lineValue(state.time, i).toPrecision(4)} ${field.unit}`;
  };

  let dragged = null;
  canvas.addEventListener('pointerdown', (event) => {
    dragged = { from: place(event), box: state.box.slice() };
    canvas.setPointerCapture(event.pointerId);
  });
  canvas.addEventListener('pointerup', () => { dragged = null; });
  canvas.addEventListener('pointermove', (event) => {
    const [x, y] = place(event);
    const box = shown.box;
    if (dragged) {
      const mx = (x - dragged.from[0]) / frame.width * (box[2] - box[0]);
      const my = (y - dragged.from[1]) / frame.height * (box[3] - box[1]);
      state.box = [dragged.box[0] - mx, dragged.box[1] + my, dragged.box[2] - mx, dragged.box[3] + my];
      draw();
      return;
    }
    const inside = x >= 0 && y >= 0 && x < frame.width && y < frame.height;
    const value = inside ? shown.pixels[Math.floor(y) * frame.width + Math.floor(x)] : NaN;
    if (Number.isNaN(value)) return;
    const wx = box[0] + x / frame.width * (box[2] - box[0]), wy = box[3] - y / frame.height * (box[3] - box[1]);
    const field = data.fields[state.field];
    const where = data.inSpace ? '' : `x = ${wx.toPrecision(4)} m, y = ${wy.toPrecision(4)} m: `;
    element('map-value').textContent =
        `${where}${field.label} = ${value.toPrecision(4)} ${field.unit}${fractureText(x, y)}`;
  });

  let film = 0;
  const stop = () => {
    clearInterval(film);
    film = 0;
    element('map-play').textContent = '▶';
  };
  element('map-play').addEventListener('click', () => {
    if (film) return stop();
    const last = data.times.length - 1;
    if (state.time === last) state.time = 0;
    element('map-play').textContent = '■';
    draw();
    film = setInterval(() => {
      if (state.time < last) ++state.time;
      draw();
      if (state.time === last) stop();
    }, 500);
  });
  element('map-play').hidden = data.times.length < 2;

  element('map-time').max = data.times.length - 1;
  element('map-time').parentElement.hidden = data.times.length < 2;
  element('map-lines').hidden = !data.times.some((time) => time.lines.length);
  element('map-field').addEventListener('change', (event) => { state.field = +event.target.value; draw(); });
  element('map-line-field').parentElement.hidden = !data.lineFields.length;
  element('map-line-field').addEventListener('change', (event) => {
    state.lineField = +event.target.value;
    setFrame();
    draw();
  });
  element('map-time').addEventListener('input', (event) => { stop(); state.time = +event.target.value; draw(); });
  element('map-scale').addEventListener('change', (event) => { state.sameScale = event.target.value === 'all'; draw(); });
  element('map-whole').addEventListener('click', () => { state.box = whole.slice(); draw(); });
  element('map-lines').addEventListener('click', () => { state.box = lineBox(); draw(); });
  element('map-in').addEventListener('click', () => zoom(0.6));
  element('map-out').addEventListener('click', () => zoom(1 / 0.6));
  setFrame();
  draw();
})();
