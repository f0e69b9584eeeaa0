// The few SVG functions that the scene needs, without a framework: in the animation loop only attributes change.
const SPACE = "http://www.w3.org/2000/svg";

export type Attributes = Record<string, string | number>;

export function make<K extends keyof SVGElementTagNameMap>(name: K, attributes: Attributes = {}, parent?: Element): SVGElementTagNameMap[K] {
  const element = document.createElementNS(SPACE, name);
  for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, String(value));
  parent?.appendChild(element);
  return element;
}

export function path(d: string, className: string, parent: Element): SVGPathElement {
  return make("path", { d, class: className }, parent);
}

export function group(className: string, parent: Element): SVGGElement {
  return make("g", { class: className }, parent);
}

const two = (value: number) => Math.round(value * 100) / 100;

/** Moves an element to a position on the screen, rotated counter-clockwise by an angle in the world. */
export function put(element: Element, x: number, y: number, angle = 0): void {
  const turned = angle ? ` rotate(${two((-angle * 180) / Math.PI)})` : "";
  element.setAttribute("transform", `translate(${two(x)} ${two(y)})${turned}`);
}
