// The mechanism on its canvas. Shapes are paths in body axes, drawn with the pose of their body.

/** A direction and a point of a body's axes, in world axes. */
const turned = (pose, [x, y]) => [pose.c * x - pose.s * y, pose.s * x + pose.c * y];
const world = (pose, point) => turned(pose, point).map((d, k) => d + (k === 0 ? pose.x : pose.y));

class Stage {
  constructor(canvas, clock) {
    this.canvas = canvas;
    this.clock = clock;
    this.context = canvas.getContext("2d");
    this.shown = { forces: true, names: false, masses: false };
    this.traced = "";
    this.arrowFactor = 1;
    this.joint = null;
    this.view = null; // [px/m], world point at the centre; null: everything fits
    this.traces = new Map();
    this.prepare();
    this.watch();
  }

  prepare() {
    for (const shape of run.scene.shapes) {
      shape.path = new Path2D();
      shape.reach = Math.max(...shape.paths.flat().map(([x, y]) => Math.hypot(x, y)), 0) + 2 * shape.size + run.scene.unit;
      for (const points of shape.paths) {
        if (shape.form === "circle") {
          shape.path.moveTo(points[0][0] + shape.size, points[0][1]);
          shape.path.arc(points[0][0], points[0][1], shape.size, 0, 2 * Math.PI);
          continue;
        }
        points.forEach(([x, y], i) => (i ? shape.path.lineTo(x, y) : shape.path.moveTo(x, y)));
        if (shape.closed || shape.form === "area") shape.path.closePath();
      }
    }
    const [x0, y0, x1, y1] = run.scene.box;
    this.box = { x: (x0 + x1) / 2, y: (y0 + y1) / 2, width: x1 - x0, height: y1 - y0 };
  }

  watch() {
    const queue = () => this.queue();
    new ResizeObserver(() => this.resize()).observe(this.canvas);
    dark.addEventListener("change", queue);
    this.clock.onChange(queue);
  }

  queue() {
    if (this.queued) return;
    this.queued = true;
    requestAnimationFrame(() => {
      this.queued = false;
      this.draw();
    });
  }

  /** As high as the mechanism needs at full width, within limits. */
  resize() {
    const width = this.canvas.clientWidth;
    if (!width) return;
    const wanted = (width * this.box.height) / this.box.width + 30;
    const height = Math.round(Math.min(Math.max(wanted, 230), Math.max(300, 0.62 * innerHeight), 900));
    this.ratio = devicePixelRatio || 1;
    this.width = width;
    this.height = height;
    this.canvas.style.height = `${height}px`;
    this.canvas.width = Math.round(width * this.ratio);
    this.canvas.height = Math.round(height * this.ratio);
    this.draw();
  }

  get fitting() {
    const foot = 26; // for the scale of the arrows
    const scale = Math.min(this.width / this.box.width, (this.height - foot) / this.box.height);
    return { scale, x: this.box.x, y: this.box.y - foot / 2 / scale };
  }

  get now() {
    return this.view ?? this.fitting;
  }

  toPixels([x, y]) {
    const v = this.now;
    return [this.width / 2 + (x - v.x) * v.scale, this.height / 2 - (y - v.y) * v.scale];
  }

  toWorld([x, y]) {
    const v = this.now;
    return [v.x + (x - this.width / 2) / v.scale, v.y - (y - this.height / 2) / v.scale];
  }

  zoom(factor, at) {
    const [x, y] = this.toWorld(at), v = this.now;
    const scale = Math.min(Math.max(v.scale * factor, 0.3 * this.fitting.scale), 1e4 * this.fitting.scale);
    const f = v.scale / scale;
    this.view = { scale, x: x + (v.x - x) * f, y: y + (v.y - y) * f };
    this.queue();
  }

  pan(dx, dy) {
    const v = this.now;
    this.view = { scale: v.scale, x: v.x - dx / v.scale, y: v.y + dy / v.scale };
    this.queue();
  }

  fit() {
    this.view = null;
    this.queue();
  }

  pose(body, place = this.clock.place) {
    if (body < 0) return { x: 0, y: 0, c: 1, s: 0 };
    const { x, y, angle } = run.scene.bodies[body];
    const read = (column) => (column < 0 ? 0 : valueAt(run.columns[column].values, place));
    const a = read(angle);
    return { x: read(x), y: read(y), c: Math.cos(a), s: Math.sin(a) };
  }

  placeOf(at, poses) {
    const poseOf = (body) => (poses ? poses[body + 1] : this.pose(body));
    const place = world(poseOf(at.body), at.point);
    if (!at.toward) return place;
    const other = this.placeOf(at.toward, poses); // on the line to another point, or offset from it in the axes of that point's body
    const off = turned(poseOf(at.toward.body), at.off);
    return place.map((a, k) => a + at.share * (other[k] - a) + off[k]);
  }

  shade(entry, body) {
    const pair = entry === "tint" ? run.paints.tints[Math.max(body, 0) % run.paints.tints.length] : entry === "paper" ? run.paints.paper : null;
    return pair ? pair[+dark.matches] : entry;
  }

  colour(name) {
    return run.paints[name][+dark.matches];
  }

  draw() {
    if (!this.width) return;
    const g = this.context, poses = [this.pose(-1), ...run.scene.bodies.map((_, i) => this.pose(i))];
    g.setTransform(this.ratio, 0, 0, this.ratio, 0, 0);
    g.fillStyle = this.colour("paper");
    g.fillRect(0, 0, this.width, this.height);
    g.lineCap = g.lineJoin = "round";
    this.drawTraces(g, poses);
    for (const shape of run.scene.shapes) this.drawShape(g, shape, poses[shape.body + 1]);
    for (const connector of run.scene.connectors) this.drawConnector(g, connector, poses);
    g.setTransform(this.ratio, 0, 0, this.ratio, 0, 0);
    if (this.joint) this.drawChoice(g, poses);
    if (this.shown.forces) this.drawForces(g, poses);
    if (this.shown.names) this.drawNames(g, poses);
    g.fillStyle = this.colour("note");
    g.font = "12.5px system-ui, Helvetica, Arial, sans-serif";
    g.textAlign = "right";
    g.fillText(`t = ${timeText(this.clock.t)}`, this.width - 10, this.height - 10);
  }

  enter(g, pose) {
    const v = this.now, k = v.scale * this.ratio;
    const left = this.width / 2 * this.ratio + (pose.x - v.x) * k, top = this.height / 2 * this.ratio - (pose.y - v.y) * k;
    g.setTransform(k * pose.c, -k * pose.s, -k * pose.s, -k * pose.c, left, top);
    return 1 / v.scale; // a pixel
  }

  drawShape(g, shape, pose) {
    if (!this.shown.masses && shape.paint.startsWith("mass")) return;
    const v = this.now, thin = run.scene.unit * v.scale < 0.7; // symbols smaller than a pixel
    if (thin && shape.form !== "bar" && shape.paint !== "gear") return;
    if (Math.abs(pose.x - v.x) > shape.reach + this.width / 2 / v.scale || Math.abs(pose.y - v.y) > shape.reach + this.height / 2 / v.scale) return;
    const style = run.paints.styles[shape.paint], pixel = this.enter(g, pose);
    const fill = this.shade(style.fill[+dark.matches], shape.body), line = this.shade(style.line[+dark.matches], shape.body);
    if (shape.form === "bar") {
      g.strokeStyle = line;
      g.lineWidth = shape.size + 2 * style.width * pixel;
      g.stroke(shape.path);
      if (thin) return;
      g.strokeStyle = g.fillStyle = fill;
      g.lineWidth = shape.size;
      g.stroke(shape.path);
      if (shape.closed) g.fill(shape.path);
      return;
    }
    if (fill && shape.form !== "line") {
      g.fillStyle = fill;
      g.fill(shape.path);
    }
    if (!line) return;
    g.strokeStyle = line;
    g.lineWidth = style.width * pixel;
    g.setLineDash(style.dash ? style.dash.split(" ").map((d) => d * pixel) : []);
    g.stroke(shape.path);
    g.setLineDash([]);
  }

  drawConnector(g, connector, poses) {
    const pixel = this.enter(g, poses[0]), style = run.paints.styles[connector.paint];
    const [a, b] = this.runOf(this.placeOf(connector.from, poses), this.placeOf(connector.to, poses), connector.radii);
    const dx = b[0] - a[0], dy = b[1] - a[1], l = Math.hypot(dx, dy) || 1, u = run.scene.unit;
    g.strokeStyle = this.shade(style.line[+dark.matches], -1);
    g.lineWidth = style.width * pixel;
    g.beginPath();
    if (connector.paint === "barrel") {
      this.drawCylinder(g, a, [dx / l, dy / l], b, connector, style);
      return;
    }
    if (connector.length > 0) this.traceBlade(g, a, b, connector, poses);
    else for (const [along, across] of connector.line) g.lineTo(a[0] + along * dx - (across * u * dy) / l, a[1] + along * dy + (across * u * dx) / l);
    g.stroke();
  }

  /** From disc to disc if it is a belt; a radius is positive if the belt is on the left of its disc. */
  runOf(a, b, radii) {
    if (!radii) return [a, b];
    const [r, s] = radii, dx = b[0] - a[0], dy = b[1] - a[1], w = s - r, far = Math.max(Math.hypot(dx, dy), Math.abs(w)), t = Math.sqrt((far - w) * (far + w));
    const x = (-t * dy - w * dx) / (far * far), y = (t * dx - w * dy) / (far * far);
    return [[a[0] + r * x, a[1] + r * y], [b[0] + s * x, b[1] + s * y]];
  }

  /** The barrel from its end forwards, and from the other end back the rod with its piston, as long as the barrel; if there are several stages, the last one. */
  drawCylinder(g, a, [x, y], b, { barrel, half_width: w }, style) {
    const l = Math.hypot(b[0] - a[0], b[1] - a[1]), rod = Math.max(barrel, l - barrel);
    const corner = (from, along, across) => [from[0] + along * x - across * w * y, from[1] + along * y + across * w * x];
    for (const [along, across] of [[0, -1], [barrel, -1], [barrel, 1], [0, 1]]) g.lineTo(...corner(a, along, across));
    g.closePath();
    g.fillStyle = this.shade(style.fill[+dark.matches], -1);
    g.fill();
    g.stroke();
    g.lineWidth *= run.paints.styles.rod.width / style.width;
    g.beginPath();
    g.moveTo(...corner(b, -rod, 0));
    g.lineTo(...b);
    g.moveTo(...corner(b, -rod, -1));
    g.lineTo(...corner(b, -rod, 1));
    g.stroke();
  }

  /** A blade: the cubic curve tangent to the axes at both its ends. */
  traceBlade(g, a, b, connector, poses) {
    const third = connector.length / 3;
    const from = this.directionOf(connector.from, poses), to = this.directionOf(connector.to, poses);
    g.moveTo(a[0], a[1]);
    g.bezierCurveTo(a[0] + third * from[0], a[1] + third * from[1], b[0] - third * to[0], b[1] - third * to[1], b[0], b[1]);
  }

  directionOf(at, poses) {
    return turned(poses[at.body + 1], [Math.cos(at.axis), Math.sin(at.axis)]);
  }

  /** Traced points: "" none, "joints", or the name of one. */
  tracedPoints() {
    if (this.traced === "joints") return run.scene.labels.filter((point) => point.at.body >= 0 && !point.at.toward);
    return run.scene.points.filter((point) => point.name === this.traced);
  }

  drawTraces(g, poses) {
    const pixel = this.enter(g, poses[0]);
    g.strokeStyle = this.colour("trace");
    g.lineWidth = 1.4 * pixel;
    for (const point of this.tracedPoints()) {
      if (!this.traces.has(point)) {
        const path = new Path2D();
        for (let row = 0; row < run.rows; ++row) {
          path.lineTo(...world(this.pose(point.at.body, { row, share: 0 }), point.at.point));
        }
        this.traces.set(point, path);
      }
      g.stroke(this.traces.get(point));
    }
    for (const point of this.tracedPoints()) {
      const [x, y] = this.placeOf(point.at, poses);
      g.fillStyle = this.colour("trace");
      g.beginPath();
      g.arc(x, y, 3 * pixel, 0, 7);
      g.fill();
    }
  }

  drawChoice(g, poses) {
    const arrow = run.scene.arrows.find((one) => one.joint === this.joint);
    if (!arrow) return;
    const [x, y] = this.toPixels(this.placeOf(arrow.at, poses));
    g.strokeStyle = this.colour("trace");
    g.lineWidth = 2.5;
    g.beginPath();
    g.arc(x, y, Math.max(9, 0.9 * run.scene.unit * this.now.scale), 0, 7);
    g.stroke();
  }

  drawForces(g, poses) {
    const { arrows, arrow_force: force, arrow_length: length } = run.scene;
    if (!(force > 0)) return;
    const zoom = this.now.scale / this.fitting.scale; // arrows grow with the zoom, but more slowly
    const perNewton = (length * this.fitting.scale * Math.sqrt(zoom) * this.arrowFactor) / force, most = run.scene.arrow_most * perNewton * force;
    let anyCut = false;
    const show = (at, xs, ys, colour) => {
      const fx = valueAt(xs, this.clock.place), fy = valueAt(ys, this.clock.place), size = Math.hypot(fx, fy) * perNewton;
      if (!(size >= 1)) return;
      anyCut ||= size > most;
      const k = Math.min(size, most) / Math.hypot(fx, fy), [x, y] = this.toPixels(this.placeOf(at, poses));
      this.drawArrow(g, x, y, x + k * fx, y - k * fy, size > most, colour);
    };
    for (const load of run.scene.loads) show(load.at, run.columns[load.fx].values, run.columns[load.fy].values, "load");
    for (const arrow of arrows)
      if (arrow.fx >= 0 && arrow.fy >= 0) show(arrow.at, run.columns[arrow.fx].values, run.columns[arrow.fy].values, "force");
    const shown = force / (this.arrowFactor * Math.sqrt(zoom)), power = 10 ** Math.floor(Math.log10(shown)), digit = shown / power;
    const nice = power * (digit >= 5 ? 5 : digit >= 2 ? 2 : 1);
    this.drawArrow(g, 12, this.height - 14, 12 + nice * perNewton, this.height - 14, false, "force");
    g.fillStyle = this.colour("ink");
    g.font = "12.5px system-ui, Helvetica, Arial, sans-serif";
    g.textAlign = "left";
    const scale = scaleFor(nice, "N");
    g.fillText(`${Number((nice / scale.factor).toPrecision(3))} ${scale.unit}${anyCut ? ", two heads: more than drawn" : ""}`, 20 + nice * perNewton, this.height - 10);
  }

  /** `cut`: the arrow is shortened and gets a second head. */
  drawArrow(g, x0, y0, x1, y1, cut, colour) {
    const l = Math.hypot(x1 - x0, y1 - y0), ux = (x1 - x0) / l, uy = (y1 - y0) / l, size = Math.min(1, l / 16), head = 10 * size, half = 4 * size;
    g.strokeStyle = g.fillStyle = this.colour(colour);
    g.lineWidth = 2.2 * Math.max(size, 0.5);
    g.lineCap = "butt";
    g.beginPath();
    g.moveTo(x0, y0);
    g.lineTo(x1 - head * ux, y1 - head * uy);
    g.stroke();
    g.lineCap = "round";
    for (const back of cut ? [0, head] : [0]) {
      const tx = x1 - back * ux, ty = y1 - back * uy;
      g.beginPath();
      g.moveTo(tx, ty);
      g.lineTo(tx - head * ux - half * uy, ty - head * uy + half * ux);
      g.lineTo(tx - head * ux + half * uy, ty - head * uy - half * ux);
      g.fill();
    }
  }

  drawNames(g, poses) {
    const off = Math.max(0.9 * run.scene.unit * this.now.scale, 5);
    g.font = "italic 13px system-ui, Helvetica, Arial, sans-serif";
    g.lineWidth = 3;
    g.strokeStyle = this.colour("paper");
    g.fillStyle = this.colour("ink");
    for (const label of run.scene.labels) {
      const [x, y] = this.toPixels(this.placeOf(label.at, poses)), wide = g.measureText(label.name).width + off + 4;
      const left = x < this.width / 2 ? x > wide : x + wide > this.width;
      g.textAlign = left ? "right" : "left";
      g.strokeText(label.name, x + (left ? -off : off), y - off);
      g.fillText(label.name, x + (left ? -off : off), y - off);
    }
  }

  /** The joint within reach of a point on the canvas. */
  jointAt(x, y) {
    let best = null, reach = 14;
    for (const arrow of run.scene.arrows) {
      const p = this.toPixels(this.placeOf(arrow.at)), d = Math.hypot(p[0] - x, p[1] - y);
      if (d < reach) [best, reach] = [arrow.joint, d];
    }
    return best;
  }
}
