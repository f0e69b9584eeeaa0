// A plot of curves over time, with the page's time as its cursor.

const drawingNamespace = (() => {
  const probe = document.createElement("div");
  probe.innerHTML = "<svg></svg>";
  return probe.firstChild.namespaceURI;
})();

function drawn(name, attributes = {}, text) {
  const element = document.createElementNS(drawingNamespace, name);
  for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
  if (text !== undefined) element.textContent = text;
  return element;
}

function made(name, properties = {}, ...children) {
  const { ariaLabel, ...others } = properties, element = Object.assign(document.createElement(name), others);
  if (ariaLabel) element.setAttribute("aria-label", ariaLabel);
  element.append(...children);
  return element;
}

const curveColour = (i) => `var(--c${i % 7})`;
const curveDash = (i) => ["", "7 3", "2 3"][Math.floor(i / 7) % 3];

class Chart {
  static all = [];

  constructor(clock) {
    this.clock = clock;
    this.head = made("div", { className: "chart-head" });
    this.svg = drawn("svg", { role: "img" });
    this.legend = made("ul", { className: "legend" });
    this.figure = made("figure", { className: "chart" }, this.head, this.svg, this.legend);
    this.height = 196;
    this.content = { title: "", unit: "", curves: [] };
    Chart.all.push(this);
    this.forget = clock.onChange(() => this.moveCursor());
    this.watch = new ResizeObserver(() => this.fitWidth());
    this.watch.observe(this.figure);
    for (const kind of ["pointerdown", "pointermove"]) this.svg.addEventListener(kind, (event) => this.seek(event));
  }

  remove() {
    this.forget();
    this.watch.disconnect();
    Chart.all = Chart.all.filter((one) => one !== this);
    this.figure.remove();
  }

  /** { title, unit, curves: [{ label, sub, values, peak: [t, value] or undefined }] } */
  show(content) {
    this.content = content;
    this.draw(this.figure.clientWidth || 620);
  }

  fitWidth() {
    if (Math.abs(this.figure.clientWidth - this.width) > 1 && this.figure.clientWidth > 0) this.draw(this.figure.clientWidth);
  }

  seek(event) {
    if (event.type === "pointermove" && !(event.buttons & 1)) return;
    if (event.type === "pointerdown") this.svg.setPointerCapture(event.pointerId);
    const box = this.svg.getBoundingClientRect(), x = ((event.clientX - box.left) / box.width) * this.width;
    this.clock.pause();
    this.clock.set(this.clock.first + ((x - this.left) / this.plotWidth) * (this.clock.last - this.clock.first));
  }

  range() {
    let low = Infinity, high = -Infinity;
    for (const curve of this.content.curves)
      for (const y of curve.peak ? [curve.peak[1], ...curve.values] : curve.values) {
        if (y < low) low = y;
        if (y > high) high = y;
      }
    if (!(low <= high) || !isFinite(low) || !isFinite(high)) return [-1, 1];
    const size = Math.max(Math.abs(low), Math.abs(high));
    if (high - low <= 1e-9 * size || high === low) {
      const margin = size > 0 ? 0.1 * size : 1;
      return [low - margin, high + margin];
    }
    const margin = 0.06 * (high - low);
    return [low >= 0 && low < margin ? 0 : low - margin, high <= 0 && high > -margin ? 0 : high + margin];
  }

  draw(width) {
    const { title, unit, curves } = this.content;
    this.width = width;
    const [low, high] = this.range(), largest = Math.max(Math.abs(low), Math.abs(high));
    this.scale = scaleFor(largest / 1.06, unit);
    this.decimals = Math.min(9, Math.max(0, 3 - Math.floor(Math.log10(largest / this.scale.factor || 1))));
    this.timeScale = scaleFor(this.clock.last, "s");
    const ticks = ticksIn(low / this.scale.factor, high / this.scale.factor, 5), labels = ticks.list.map(ticks.text);
    this.left = 22 + 7.2 * Math.max(...labels.map((text) => text.length), 2);
    this.top = 20;
    this.plotWidth = Math.max(60, width - this.left - 10);
    this.plotHeight = this.height - this.top - 36;
    const span = this.clock.last - this.clock.first || 1;
    this.px = (t) => this.left + ((t - this.clock.first) / span) * this.plotWidth;
    this.py = (y) => this.top + ((high - y) / (high - low)) * this.plotHeight;
    const svg = this.svg;
    svg.replaceChildren();
    svg.setAttribute("viewBox", `0 0 ${width} ${this.height}`);
    svg.setAttribute("aria-label", `${title}: ${curves.map((c) => c.label + c.sub).join(", ")} in ${this.scale.unit || "1"} over time`);
    this.drawAxes(ticks, low, high);
    curves.forEach((curve, i) => svg.append(this.drawCurve(curve, i)));
    curves.forEach((curve, i) => curve.peak && svg.append(this.drawPeak(curve, i)));
    this.cursor = drawn("path", { class: "cursor" });
    this.dots = curves.map((_, i) => drawn("circle", { class: "cursor-dot", r: 3.4, fill: curveColour(i) }));
    svg.append(this.cursor, ...this.dots);
    this.drawLegend();
    this.moveCursor();
  }

  drawAxes(ticks, low, high) {
    const { svg, left, top, plotWidth, plotHeight } = this, bottom = top + plotHeight;
    for (const y of ticks.list) {
      const at = this.py(y * this.scale.factor);
      svg.append(drawn("path", { class: y === 0 && low < 0 && high > 0 ? "zero" : "grid", d: `M${left} ${at}h${plotWidth}` }));
      svg.append(drawn("text", { x: left - 6, y: at + 4, "text-anchor": "end" }, ticks.text(y)));
    }
    const across = ticksIn(this.clock.first / this.timeScale.factor, this.clock.last / this.timeScale.factor, Math.max(2, plotWidth / 90));
    for (const t of across.list) {
      const at = this.px(t * this.timeScale.factor);
      svg.append(drawn("path", { class: "grid", d: `M${at} ${top}v${plotHeight}` }));
      svg.append(drawn("text", { x: at, y: bottom + 16, "text-anchor": "middle" }, across.text(t)));
    }
    svg.append(drawn("path", { class: "axis", d: `M${left} ${top}V${bottom}H${left + plotWidth}` }));
    svg.append(drawn("text", { x: left + plotWidth, y: bottom + 31, "text-anchor": "end" }, `time [${this.timeScale.unit}]`));
    svg.append(drawn("text", { x: 0, y: 11 }, this.scale.unit ? `[${this.scale.unit}]` : ""));
  }

  /** Each column of half a pixel keeps its first, lowest, highest and last value. */
  drawCurve(curve, index) {
    let d = "", pen = "M", column = null, kept = [];
    const put = (x, y) => {
      d += `${pen}${x.toFixed(1)} ${y.toFixed(2)}`;
      pen = "L";
    };
    const flush = () => {
      if (!kept.length) return;
      let low = kept[0], high = kept[0];
      for (const p of kept) {
        if (p[1] < low[1]) low = p;
        if (p[1] > high[1]) high = p;
      }
      for (const p of [...new Set([kept[0], low, high, kept[kept.length - 1]])].sort((a, b) => a[0] - b[0])) put(p[0], p[1]);
      kept = [];
    };
    for (let i = 0; i < times.length; ++i) {
      const x = this.px(times[i]), y = this.py(curve.values[i]);
      if (!isFinite(y)) {
        flush();
        pen = "M";
        continue;
      }
      if (Math.floor(2 * x) !== column) flush();
      column = Math.floor(2 * x);
      kept.push([x, y]);
    }
    flush();
    return drawn("path", { class: "curve", d, stroke: curveColour(index), "stroke-dasharray": curveDash(index) });
  }

  drawPeak(curve, index) {
    const [t, y] = curve.peak, dot = drawn("circle", { class: "peak", cx: this.px(t).toFixed(1), cy: this.py(y).toFixed(1), r: 2.6, fill: curveColour(index) });
    dot.append(drawn("title", {}, `peak ${fixed(y / this.scale.factor, this.decimals)} ${this.scale.unit}`));
    return dot;
  }

  drawLegend() {
    this.values = this.content.curves.map(() => made("b"));
    this.legend.replaceChildren(
      ...this.content.curves.map((curve, i) => {
        const sample = made("i");
        sample.style.background = curveColour(i);
        return made("li", {}, sample, curve.label, made("sub", { textContent: curve.sub }), " ", this.values[i]);
      })
    );
  }

  moveCursor() {
    if (!this.cursor) return;
    const x = this.px(this.clock.t);
    this.cursor.setAttribute("d", `M${x.toFixed(1)} ${this.top}v${this.plotHeight}`);
    this.content.curves.forEach((curve, i) => {
      const y = valueAt(curve.values, this.clock.place);
      this.values[i].textContent = isFinite(y) ? `${fixed(y / this.scale.factor, this.decimals)} ${this.scale.unit}` : "–";
      this.dots[i].setAttribute("cx", x.toFixed(1));
      this.dots[i].setAttribute("cy", isFinite(y) ? this.py(y).toFixed(1) : -99);
    });
  }
}
