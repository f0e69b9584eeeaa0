// The polar load diagram of a pin: the path of the tip of the force vector, in world axes or in the axes of the pin's marker on either body.

/** Force on the second body in world axes, or on the body whose axes are chosen: { x, y, on, axes }. */
function pinForces(joint, axes) {
  const [fx, fy] = [joint.fx, joint.fy].map((i) => run.columns[i].values), { first, second } = joint.pin;
  if (axes === "world") return { x: fx, y: fy, on: second.on, axes: "world axes" };
  const side = axes === "first" ? first : second, sign = axes === "first" ? -1 : 1;
  const turned = side.body < 0 ? null : run.columns[run.scene.bodies[side.body].angle].values;
  const x = new Float64Array(fx.length), y = new Float64Array(fx.length);
  for (let i = 0; i < fx.length; ++i) {
    const angle = side.axis + (turned ? turned[i] : 0), c = Math.cos(angle), s = Math.sin(angle);
    x[i] = sign * (c * fx[i] + s * fy[i]);
    y[i] = sign * (c * fy[i] - s * fx[i]);
  }
  return { x, y, on: side.on, axes: `axes of ${side.marker}` };
}

class PolarChart extends Chart {
  constructor(clock, joints) {
    super(clock);
    this.figure.classList.add("polar");
    this.joints = joints;
    this.what = made("select", { ariaLabel: "Pin of the polar load diagram" });
    this.which = made("select", { ariaLabel: "Axes of the polar load diagram" });
    this.title = made("span", { className: "title", textContent: "Polar load diagram" });
    joints.forEach((joint, i) => this.what.append(made("option", { value: i, textContent: `Joint ${joint.name}` })));
    this.head.append(this.title, this.what, this.which);
    this.what.addEventListener("change", () => this.pick(joints[this.what.value]));
    this.which.addEventListener("change", () => this.showAxes(this.which.value));
    this.pick(joints[0]);
  }

  pick(joint) {
    const { first, second } = joint.pin, kept = this.which.value || "world";
    this.joint = joint;
    this.what.value = this.joints.indexOf(joint);
    this.which.replaceChildren(
      made("option", { value: "world", textContent: `on ${second.on}, world axes` }),
      made("option", { value: "first", textContent: `on ${first.on}, axes of ${first.marker}` }),
      made("option", { value: "second", textContent: `on ${second.on}, axes of ${second.marker}` })
    );
    this.showAxes(kept);
  }

  showAxes(axes) {
    this.which.value = axes;
    this.forces = pinForces(this.joint, axes);
    this.title.textContent = `Polar load diagram of joint ${this.joint.name}: force on ${this.forces.on}, ${this.forces.axes}`;
    this.draw(this.figure.clientWidth || 620);
  }

  /** Moves to the row whose force is nearest to the pointer. */
  seek(event) {
    if (!this.forces || (event.type === "pointermove" && !(event.buttons & 1))) return;
    const box = this.svg.getBoundingClientRect(), shrunk = this.width / box.width;
    const px = (event.clientX - box.left) * shrunk, py = (event.clientY - box.top) * shrunk;
    let nearest = 0, least = Infinity;
    for (let i = 0; i < times.length; ++i) {
      const [x, y] = this.place(this.forces.x[i], this.forces.y[i]), far = Math.hypot(x - px, y - py);
      if (far < least) [least, nearest] = [far, i];
    }
    this.clock.pause();
    this.clock.set(times[nearest]);
  }

  draw(width) {
    if (!this.forces) return;
    const { x, y } = this.forces;
    let largest = 0;
    for (let i = 0; i < x.length; ++i) {
      const size = Math.hypot(x[i], y[i]);
      if (isFinite(size) && size > largest) largest = size;
    }
    this.width = width;
    this.scale = scaleFor(largest, "N");
    const side = Math.min(width, 360), high = largest / this.scale.factor || 1, radius = side / 2 - 22;
    const middle = [width / 2, side / 2];
    this.decimals = Math.min(9, Math.max(0, 3 - Math.floor(Math.log10(high))));
    this.place = (fx, fy) => [middle[0] + (radius * fx) / this.scale.factor / high, middle[1] - (radius * fy) / this.scale.factor / high];
    this.svg.replaceChildren();
    this.svg.setAttribute("viewBox", `0 0 ${width} ${side}`);
    this.svg.setAttribute("aria-label", `${this.title.textContent}; largest force ${fixed(high, this.decimals)} ${this.scale.unit}`);
    this.drawRings(middle, radius, ticksIn(0, high, 4), high);
    this.svg.append(drawn("path", { class: "curve", d: this.path(), stroke: curveColour(0) }));
    this.cursor = drawn("path", { class: "axis" });
    this.dot = drawn("circle", { class: "cursor-dot", r: 4, fill: curveColour(0) });
    this.svg.append(this.cursor, this.dot);
    this.value = made("b");
    this.legend.replaceChildren(made("li", {}, "|F| ", this.value));
    this.moveCursor();
  }

  drawRings([cx, cy], radius, ticks, high) {
    for (let i = 0; i < 12; ++i) {
      const angle = (i * Math.PI) / 6;
      this.svg.append(drawn("path", { class: "grid", d: `M${cx} ${cy}l${(radius * Math.cos(angle)).toFixed(2)} ${(radius * Math.sin(angle)).toFixed(2)}` }));
    }
    for (const [d, name, x, y] of [[`M${cx} ${cy}h${radius + 6}`, "x", cx + radius + 9, cy + 4], [`M${cx} ${cy}v${-radius - 6}`, "y", cx - 3, cy - radius - 10]]) {
      this.svg.append(drawn("path", { class: "zero", d }), drawn("text", { x, y }, name));
    }
    const rings = ticks.list.filter((tick) => tick > 0), slant = Math.SQRT1_2;
    for (const ring of rings) {
      const r = (radius * ring) / high;
      this.svg.append(drawn("circle", { class: "grid", fill: "none", cx, cy, r }));
      this.svg.append(drawn("text", { x: cx + slant * r, y: cy + slant * r + 4, "text-anchor": "middle" }, ticks.text(ring) + (ring === rings[rings.length - 1] ? ` ${this.scale.unit}` : "")));
    }
  }

  /** Points within half a pixel of the previous one are left out. */
  path() {
    let d = "", last = null, pen = "M";
    for (let i = 0; i < times.length; ++i) {
      const point = this.place(this.forces.x[i], this.forces.y[i]);
      if (!isFinite(point[0]) || !isFinite(point[1])) {
        pen = "M";
        last = null;
        continue;
      }
      if (last && i + 1 < times.length && Math.hypot(point[0] - last[0], point[1] - last[1]) < 0.5) continue;
      d += `${pen}${point[0].toFixed(1)} ${point[1].toFixed(1)}`;
      pen = "L";
      last = point;
    }
    return d;
  }

  moveCursor() {
    if (!this.cursor || !this.forces) return;
    const fx = valueAt(this.forces.x, this.clock.place), fy = valueAt(this.forces.y, this.clock.place), size = Math.hypot(fx, fy), known = isFinite(size);
    const [x, y] = known ? this.place(fx, fy) : [-99, -99], [cx, cy] = this.place(0, 0);
    this.cursor.setAttribute("d", known ? `M${cx} ${cy}L${x.toFixed(1)} ${y.toFixed(1)}` : "");
    this.dot.setAttribute("cx", x.toFixed(1));
    this.dot.setAttribute("cy", y.toFixed(1));
    this.value.textContent = known ? `${fixed(size / this.scale.factor, this.decimals)} ${this.scale.unit} at ${fixed((Math.atan2(fy, fx) * 180) / Math.PI, 1)}°` : "–";
  }
}
