// Axes and curves in SVG.

function makeSvg(tag, attributes = {}, ...children) {
  const node = document.createElementNS('http://www.w3.org/2000/svg', tag);
  for (const [name, value] of Object.entries(attributes)) node.setAttribute(name, value);
  node.append(...children);
  return node;
}

/** Round numbers between low and high, about `wanted` of them. */
function linearTicks(low, high, wanted) {
  const rough = (high - low) / wanted, power = 10 ** Math.floor(Math.log10(rough));
  const step = [1, 2, 5, 10].map((k) => k * power).find((s) => s >= rough) ?? 10 * power;
  const ticks = [];
  for (let k = Math.ceil(low / step - 1e-9); k <= high / step + 1e-9; ++k) ticks.push(k * step);
  return ticks;
}

/** Powers of ten, or where there are few of them 1, 2, 5 of each. */
function logTicks(low, high, wanted) {
  const first = Math.ceil(Math.log10(low) - 1e-9), last = Math.floor(Math.log10(high) + 1e-9);
  const skip = Math.max(1, Math.ceil((last - first + 1) / wanted));
  const ticks = [];
  for (let e = first; e <= last; e += skip) ticks.push(10 ** e);
  if (ticks.length >= 3) return ticks;
  const fine = [];
  for (let e = first - 1; e <= last; ++e)
    for (const k of [1, 2, 5])
      if (k * 10 ** e >= low * 0.999 && k * 10 ** e <= high * 1.001) fine.push(k * 10 ** e);
  return fine.length >= 2 ? fine : [low, high];
}

function tickText(x) {
  const size = Math.abs(x);
  if (size !== 0 && (size >= 1e5 || size < 1e-3))
    return x.toExponential(0).replace('e+', 'e').replaceAll('-', '−');
  return String(Number(x.toPrecision(6))).replace('-', '−');
}

/** An axis: from values to pixels and back. */
class Axis {
  constructor(low, high, isLog, from, to) {
    const same = !(high > low);
    this.isLog = isLog;
    this.low = same && !isLog ? low - (Math.abs(low) || 1) / 2 : same ? low / 2 : low;
    this.high = same && !isLog ? high + (Math.abs(high) || 1) / 2 : same ? high * 2 : high;
    this.from = from;
    this.to = to;
  }
  share(x) {
    if (!this.isLog) return (x - this.low) / (this.high - this.low);
    return Math.log(Math.max(x, 1e-300) / this.low) / Math.log(this.high / this.low);
  }
  pixel(x) { return this.from + Math.max(-0.02, Math.min(1.02, this.share(x))) * (this.to - this.from); }
  value(pixel) {
    const share = (pixel - this.from) / (this.to - this.from);
    return this.isLog ? this.low * (this.high / this.low) ** share :
                        this.low + share * (this.high - this.low);
  }
  ticks(wanted) {
    return this.isLog ? logTicks(this.low, this.high, wanted) : linearTicks(this.low, this.high, wanted);
  }
}

/** A figure with a caption, a drawing of its own size, and a line about what is under the pointer. */
class Figure {
  /**
   * draw(figure) is called whenever the size changes; hover(x, y) with pixels, or null, returns that line.
   */
  constructor(caption, describe) {
    this.svg = makeSvg('svg', {tabindex: '0', role: 'img', 'aria-label': describe});
    this.readout = make('div', {class: 'readout', 'aria-live': 'polite'});
    this.keys = make('div', {class: 'keys'});
    this.node = make('figure', {}, make('figcaption', {}, ...caption), this.svg, this.keys, this.readout);
    this.hover = () => {};
    this.step = () => {};
    this.svg.addEventListener('pointermove', (event) => this.at(event));
    this.svg.addEventListener('pointerdown', (event) => this.at(event));
    this.svg.addEventListener('pointerleave', () => this.clear());
    this.svg.addEventListener('blur', () => this.clear());
    this.svg.addEventListener('keydown', (event) => {
      if (event.key !== 'ArrowLeft' && event.key !== 'ArrowRight') return;
      event.preventDefault();
      this.step(event.key === 'ArrowRight' ? 1 : -1);
    });
    this.observer = new ResizeObserver(() => {
      const {clientWidth, clientHeight} = this.svg;
      if (clientWidth === this.width && clientHeight === this.height) return;
      this.redraw();
    });
    this.observer.observe(this.svg);
  }

  at(event) {
    const box = this.svg.getBoundingClientRect();
    this.hover(event.clientX - box.left, event.clientY - box.top);
  }
  clear() {
    this.cursor.replaceChildren();
    this.readout.textContent = '';
  }

  redraw() {
    this.width = this.svg.clientWidth;
    this.height = this.svg.clientHeight;
    if (this.width < 50) return;
    this.svg.setAttribute('viewBox', `0 0 ${this.width} ${this.height}`);
    this.svg.replaceChildren();
    this.cursor = makeSvg('g', {class: 'cursor'});
    this.draw();
    this.svg.append(this.cursor);
  }

  /** Axes for the given ranges, with grid and names. */
  axes(x, y, xName, yName) {
    const left = 52, right = this.width - 12, top = 24, bottom = this.height - 40;
    this.x = new Axis(x.low, x.high, x.isLog, left, right);
    this.y = new Axis(y.low, y.high, y.isLog, bottom, top);
    let grid = '';
    for (const tick of this.x.ticks(Math.max(2, Math.floor(this.width / 85)))) {
      const at = this.x.pixel(tick);
      grid += `M${at.toFixed(1)} ${top}V${bottom}`;
      this.svg.append(makeSvg('text', {x: at, y: bottom + 16, 'text-anchor': 'middle'}, tickText(tick)));
    }
    for (const tick of this.y.ticks(6)) {
      const at = this.y.pixel(tick);
      grid += `M${left} ${at.toFixed(1)}H${right}`;
      this.svg.append(makeSvg('text', {x: left - 6, y: at + 4, 'text-anchor': 'end'}, tickText(tick)));
    }
    this.svg.prepend(makeSvg('path', {class: 'grid', d: grid}));
    this.svg.append(
        makeSvg('path', {class: 'axis', d: `M${left} ${top}V${bottom}H${right}`}),
        makeSvg('text', {x: (left + right) / 2, y: this.height - 5, 'text-anchor': 'middle'}, xName),
        makeSvg('text', {x: 4, y: 12}, yName));
  }

  line(path, color, dash) {
    const attributes = {class: 'curve', d: path, stroke: color};
    if (dash) attributes['stroke-dasharray'] = dash;
    this.svg.append(makeSvg('path', attributes));
  }
  key(color, dash, text) {
    const mark = makeSvg(
        'svg', {'aria-hidden': 'true', width: 22, height: 8, style: 'width:22px;height:8px'},
        makeSvg('path', {d: 'M0 4H22', stroke: color, 'stroke-width': 3, 'stroke-dasharray': dash}));
    this.keys.append(make('span', {}, mark, text));
  }
}
