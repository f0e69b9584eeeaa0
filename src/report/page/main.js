// Sets up the page: controls, plots, tables.

const byId = (id) => document.getElementById(id);
const clock = new Clock(times);
const stageShown = byId("stage") !== null;
const stage = stageShown ? new Stage(byId("mechanism"), clock) : null;
const largestFirst = run.joints.filter((joint) => joint.fx >= 0 && joint.fy >= 0).sort((a, b) => b.peak - a.peak);
const ticked = new Set(largestFirst.slice(0, 5).map((joint) => joint.name));
document.documentElement.classList.add("js");

function setUpStage() {
  byId("stage").hidden = false;
  const { width, height } = stage.box;
  if (width > 2.3 * height) document.querySelector("main").classList.add("wide");
  const slider = byId("time"), play = byId("play"), speed = byId("speed");
  slider.max = run.rows - 1;
  slider.addEventListener("input", () => {
    clock.pause();
    clock.set(times[Number(slider.value)]);
  });
  play.addEventListener("click", () => clock.toggle());
  byId("back").addEventListener("click", () => clock.step(-1));
  byId("on").addEventListener("click", () => clock.step(1));
  clock.onChange(() => {
    const text = timeText(clock.t);
    play.textContent = clock.playing ? "Pause" : "Play";
    play.setAttribute("aria-pressed", clock.playing);
    slider.value = clock.place.row;
    slider.setAttribute("aria-valuetext", text);
    byId("clock").textContent = text;
  });
  fillSpeeds(speed);
  for (const name of ["forces", "names", "masses"]) {
    const box = byId(name);
    if (name === "names") box.checked = run.scene.labels.length <= 12;
    stage.shown[name] = box.checked;
    box.addEventListener("change", () => {
      stage.shown[name] = box.checked;
      stage.queue();
    });
  }
  byId("arrow-size").addEventListener("input", (event) => {
    stage.arrowFactor = 10 ** Number(event.target.value);
    stage.queue();
  });
  fillTraces(byId("trace"));
  followPointer();
}

/** Round speed factors; the default shows the whole run in about eight seconds, or in real time. */
function fillSpeeds(select) {
  const span = clock.last - clock.first || 1, natural = span / 8;
  const round = (x) => {
    const power = 10 ** Math.floor(Math.log10(x)), digit = x / power;
    return power * (digit < 1.5 ? 1 : digit < 3.5 ? 2 : digit < 7.5 ? 5 : 10);
  };
  const usual = span >= 3 && span <= 20 ? 1 : round(natural);
  const speeds = [...new Set([0.01, 0.1, 0.2, 0.5, 1, 2, 5, 10].map((f) => Number((f * usual).toPrecision(1))).concat(1))].sort((a, b) => a - b);
  for (const x of speeds) select.append(made("option", { value: x, textContent: x === 1 ? "1× (real time)" : `${x < 1e-3 ? digits(x) : x}×` }));
  select.value = usual;
  clock.speed = usual;
  select.addEventListener("change", () => (clock.speed = Number(select.value)));
}

function fillTraces(select) {
  const option = (value, text) => made("option", { value, textContent: text });
  select.append(option("", "nothing"), option("joints", "all joints"), ...run.scene.points.map((point) => option(point.name, point.name)));
  select.addEventListener("change", () => {
    stage.traced = select.value;
    stage.queue();
  });
}

function followPointer() {
  const canvas = stage.canvas, fit = byId("fit");
  let from = null, moved = false;
  const zoomed = () => (fit.hidden = stage.view === null);
  canvas.addEventListener("wheel", (event) => {
    if (document.activeElement !== canvas && !event.ctrlKey) return; // scrolling the page must not zoom by accident
    event.preventDefault();
    stage.zoom(1.0015 ** -event.deltaY, [event.offsetX, event.offsetY]);
    zoomed();
  }, { passive: false });
  canvas.addEventListener("pointerdown", (event) => {
    from = [event.clientX, event.clientY];
    moved = false;
    canvas.setPointerCapture(event.pointerId);
  });
  canvas.addEventListener("pointermove", (event) => {
    if (!from) return;
    const dx = event.clientX - from[0], dy = event.clientY - from[1];
    if (!moved && Math.hypot(dx, dy) < 4) return;
    moved = true;
    stage.pan(dx, dy);
    from = [event.clientX, event.clientY];
    zoomed();
  });
  canvas.addEventListener("pointerup", (event) => {
    from = null;
    const joint = moved ? null : stage.jointAt(event.offsetX, event.offsetY);
    if (joint) choose(joint);
  });
  canvas.addEventListener("dblclick", () => fit.click());
  fit.addEventListener("click", () => {
    stage.fit();
    zoomed();
  });
}

function onKey(event) {
  const field = event.target.closest("select, textarea, input:not([type=checkbox]), button, summary, pre, .scroller");
  if (event.ctrlKey || event.metaKey || event.altKey || (field && !(field.id === "time" && event.key === " "))) return;
  const actions = {
    " ": () => event.repeat || clock.toggle(),
    ArrowLeft: () => clock.step(event.shiftKey ? -10 : -1),
    ArrowRight: () => clock.step(event.shiftKey ? 10 : 1),
    Home: () => clock.set(clock.first),
    End: () => clock.set(clock.last),
  };
  const onCanvas = stage && event.target === stage.canvas;
  if (onCanvas) {
    const middle = [stage.width / 2, stage.height / 2];
    actions["+"] = actions["="] = () => stage.zoom(1.25, middle);
    actions["-"] = () => stage.zoom(0.8, middle);
    actions["0"] = () => stage.fit();
  }
  const action = actions[event.key];
  if (!action || (event.target.type === "checkbox" && event.key === " ")) return;
  event.preventDefault();
  action();
  if (stage) byId("fit").hidden = stage.view === null;
}

/** All ticked joints in one plot. */
function overview() {
  const joints = run.joints.filter((joint) => ticked.has(joint.name) && joint.fx >= 0 && joint.fy >= 0);
  return {
    title: "Joint forces, magnitude",
    unit: "N",
    curves: joints.map((joint) => ({ label: joint.name, sub: "", values: curveValues({ of: [joint.fx, joint.fy] }), peak: [joint.peak_time, joint.peak] })),
  };
}

function contentOf(group, quantity) {
  return { title: `${group.kind} ${group.name}: ${quantity.title}`, unit: quantity.unit, curves: quantity.curves.map((curve) => ({ ...curve, values: curveValues(curve), peak: peakOf(group, curve) })) };
}

/** Time and size of the peak of a joint's force, which may lie between rows. */
function peakOf(group, curve) {
  const joint = group.kind === "Joint" ? run.joints.find((one) => one.name === group.name) : undefined;
  return joint && curve.of?.length === 2 && curve.of[0] === joint.fx && curve.of[1] === joint.fy ? [joint.peak_time, joint.peak] : undefined;
}

/** A chart with two lists to choose from: the object and the quantity. */
class ChosenChart extends Chart {
  constructor(clock, group, quantity) {
    super(clock);
    this.what = made("select", { ariaLabel: "Plotted object" });
    this.which = made("select", { ariaLabel: "Quantity" });
    const remove = made("button", { className: "remove", textContent: "✕", title: "Remove this plot", ariaLabel: "Remove this plot" });
    this.title = made("span", { className: "title print-only" });
    const kinds = new Map();
    run.groups.forEach((one, i) => {
      if (!kinds.has(one.kind)) kinds.set(one.kind, made("optgroup", { label: one.kind }));
      kinds.get(one.kind).append(made("option", { value: i, textContent: `${one.kind} ${one.name}`.trim() }));
    });
    this.what.append(...kinds.values());
    this.head.append(this.title, this.what, this.which, remove);
    this.what.addEventListener("change", () => this.pick(run.groups[this.what.value], 0));
    this.which.addEventListener("change", () => this.pick(run.groups[this.what.value], Number(this.which.value)));
    remove.addEventListener("click", () => this.remove());
    this.pick(group, quantity);
  }

  remove() {
    super.remove();
    if (jointChart === this) jointChart = null;
  }

  pick(group, quantity) {
    this.what.value = run.groups.indexOf(group);
    this.which.replaceChildren(...group.quantities.map((one, i) => made("option", { value: i, textContent: one.title })));
    this.which.value = quantity;
    const content = contentOf(group, group.quantities[quantity]);
    this.title.textContent = content.title;
    this.show(content);
  }
}

const groupOf = (kind, name) => run.groups.find((group) => group.kind === kind && (name === undefined || group.name === name));
let overviewChart = null, jointChart = null, polarChart = null;

function setUpCharts() {
  const host = byId("charts");
  if (largestFirst.length > 1) {
    overviewChart = new Chart(clock);
    overviewChart.head.append(made("span", { className: "title", textContent: "Joint forces, magnitude" }),
      made("span", { className: "hint", textContent: "tick joints in the table below" }));
    host.append(overviewChart.figure);
    overviewChart.show(overview());
  }
  const first = largestFirst.length ? groupOf("Joint", largestFirst[0].name) : null;
  const other = groupOf("Motor") ?? groupOf("Body");
  for (const [group, quantity] of [[first, 0], [other, group3(other)]]) {
    if (!group) continue;
    const chart = new ChosenChart(clock, group, quantity);
    if (group === first) jointChart = chart;
    host.append(chart.figure);
    chart.fitWidth();
  }
  const pins = largestFirst.filter((joint) => joint.pin);
  if (pins.length) {
    polarChart = new PolarChart(clock, pins);
    host.append(polarChart.figure);
    polarChart.fitWidth();
  }
  const more = made("button", { textContent: "Add a plot" });
  more.addEventListener("click", () => {
    const chart = new ChosenChart(clock, run.groups[0], 0);
    host.insertBefore(chart.figure, null);
    chart.fitWidth();
    chart.what.focus();
  });
  if (run.groups.length) host.after(made("div", { className: "bar" }, more));
  const energy = groupOf("Energy");
  if (!energy) return;
  const chart = new Chart(clock);
  byId("energy").append(chart.figure);
  chart.show(contentOf(energy, energy.quantities[0]));
}

/** For a body the spin is more informative than its position. */
function group3(group) {
  const spin = group ? group.quantities.findIndex((one) => one.title === "Spin") : -1;
  return spin < 0 ? 0 : spin;
}

function choose(joint) {
  const group = groupOf("Joint", joint);
  if (stage) {
    stage.joint = joint;
    stage.queue();
  }
  for (const row of document.querySelectorAll("#force-table tbody tr")) row.classList.toggle("chosen", row.dataset.joint === joint);
  const pin = polarChart?.joints.find((one) => one.name === joint);
  if (pin) polarChart.pick(pin);
  if (!group) return;
  if (jointChart) return jointChart.pick(group, 0);
  jointChart = new ChosenChart(clock, group, 0);
  byId("charts").append(jointChart.figure);
  jointChart.fitWidth();
}

function setUpTable() {
  for (const row of document.querySelectorAll("#force-table tbody tr")) {
    const box = row.querySelector("input"), joint = row.dataset.joint;
    box.checked = ticked.has(joint);
    box.addEventListener("change", () => {
      if (box.checked) ticked.add(joint);
      else ticked.delete(joint);
      overviewChart?.show(overview());
    });
    row.addEventListener("click", (event) => {
      if (event.target === box || event.target.contains(box)) return;
      clock.pause();
      clock.set(Number(row.dataset.t));
      choose(joint);
    });
  }
  document.querySelectorAll("table.sortable").forEach(makeSortable);
}

/** A click on a numeric column header sorts by it, largest first; another click reverses the order. */
function makeSortable(table) {
  const body = table.tBodies[0];
  if (body.rows.length < 2) return;
  [...table.tHead.rows[0].cells].forEach((head, i) => {
    if (i === 0 && table.id === "force-table") return;
    const button = made("button", { type: "button", title: "Sort" });
    button.append(...head.childNodes);
    head.append(button);
    button.addEventListener("click", () => {
      const down = head.getAttribute("aria-sort") !== "descending", key = (row) => row.cells[i].dataset.v ?? row.cells[i].textContent;
      for (const other of table.tHead.rows[0].cells) other.removeAttribute("aria-sort");
      head.setAttribute("aria-sort", down ? "descending" : "ascending");
      const order = (a, b) => (isNaN(key(a)) || isNaN(key(b)) ? key(b).localeCompare(key(a)) : key(b) - key(a));
      body.append(...[...body.rows].sort((a, b) => (down ? order(a, b) : order(b, a))));
    });
  });
}

/** For print: the force of every joint, or if there are too many, the largest. */
function setUpPrint() {
  const most = 24;
  let host = null;
  addEventListener("afterprint", () => Chart.all.forEach((chart) => chart.fitWidth()));
  addEventListener("beforeprint", () => {
    clock.pause();
    for (const chart of Chart.all) chart.draw(chart.figure.parentElement?.id === "energy" ? 760 : 380);
    if (host || largestFirst.length < 2) return;
    host = made("div", { id: "all-forces" });
    const section = made("section", { className: "print-only" }, made("h2", { textContent: "Forces of the joints" }), host);
    if (largestFirst.length > most) section.append(made("p", { className: "note", textContent: `The largest ${most} of ${largestFirst.length} joints.` }));
    byId("plots").after(section);
    for (const joint of largestFirst.slice(0, most)) {
      const group = groupOf("Joint", joint.name), chart = new Chart(clock), content = contentOf(group, group.quantities[0]);
      chart.head.append(made("span", { className: "title", textContent: content.title }));
      host.append(chart.figure);
      chart.show(content);
      chart.draw(380);
    }
  });
}

if (stage) setUpStage();
setUpCharts();
setUpTable();
setUpPrint();
addEventListener("keydown", onKey);
if (["failed", "interrupted", "runaway", "energy_open"].includes(run.outcome)) clock.set(clock.last);
else if (largestFirst.length) clock.set(largestFirst[0].peak_time);
