// Another law of a joint, or another friction, stops or detent beside it: with a value for each key that it must have there, without those
// that only the former law knew. Which must be stated, the kernel says: it depends on the joint, and on the model's defaults.
import { edit } from "../../actions";
import type { Catalog, CatalogKey, Complaint } from "../../kernel/protocol";
import { Draft, type Literal } from "../../model/edit";
import type { Joint } from "../../model/model";
import { nodeAt, parseToml, plain } from "../../model/toml";
import { kernel } from "../../play/kernel-session";
import { studio } from "../../state";

type Law = Catalog["laws"][number];
export type Role = Law["role"];

const ROLES: readonly Role[] = ["law", "friction", "stops", "detent"];

/** An empty word takes the law of this role away, or leaves it to the model's defaults. One step of undo. */
export async function chooseLaw(catalog: Catalog, joint: Joint, role: Role, word: string): Promise<void> {
  const stated = (at: Role) => (at === "law" ? find(catalog, at, joint.law) : (statedLaw(catalog, at, joint) ?? statedLaw(catalog, at, null)));
  await choose(catalog, joint, role, word, stated(role), ROLES.filter((one) => one !== role).map(stated));
}

/** Dry friction of all joints that can have it; an empty word takes it away. One step of undo. */
export async function chooseDefaultFriction(catalog: Catalog, word: string): Promise<void> {
  const others = studio.get().model.joints.flatMap((joint) => [find(catalog, "law", joint.law), statedLaw(catalog, "friction", joint)]);
  await choose(catalog, null, "friction", word, statedLaw(catalog, "friction", null), others);
}

/** Whose law it is: a joint's, or with null that of all joints that say nothing. */
type Owner = Joint | null;

const tableOf = (owner: Owner) => (owner ? ["joint", owner.name] : ["defaults", "joint"]);

const find = (catalog: Catalog, role: Role, word: string) => catalog.laws.find((one) => one.role === role && one.word === word);

function statedLaw(catalog: Catalog, role: Role, owner: Owner): Law | undefined {
  const node = nodeAt(studio.get().model.document.root, [...tableOf(owner), role]);
  return node && find(catalog, role, String(plain(node)));
}

async function choose(catalog: Catalog, owner: Owner, role: Role, word: string, before: Law | undefined, others: readonly (Law | undefined)[]): Promise<void> {
  const { document } = studio.get().model;
  const table = tableOf(owner);
  const law = find(catalog, role, word);
  const keys = [law, ...others].flatMap((one) => one?.keys ?? []);
  const draft = new Draft(document);
  // Values that no law knows any more would be errors.
  for (const { name } of before?.keys ?? []) if (keys.every((one) => one.name !== name)) draft.remove([...table, name]);
  if (word) draft.set([...table, role], word);
  else draft.remove([...table, role]);
  const text = law ? await withMissingKeys(draft.apply(), owner, law) : draft.apply();
  if (studio.get().model.document !== document) return; // the answer came too late: there is another text
  edit(text, `${role.charAt(0).toUpperCase()}${role.slice(1)} of ${owner?.name ?? "all joints"}`);
}

/** States the keys of the law that the kernel misses. It asks again, because some are missed only when others are there. */
async function withMissingKeys(text: string, owner: Owner, law: Law): Promise<string> {
  const table = tableOf(owner);
  const tried = new Set<string>();
  for (;;) {
    const complaints = await kernel.read(text).then((answer) => answer.complaints, () => []);
    const { root } = parseToml(text);
    const missing = law.keys.filter((key) => !tried.has(key.name) && !nodeAt(root, [...table, key.name]) && complaints.some((one) => misses(one, owner, law.role, key)));
    if (missing.length === 0) return text;
    const draft = new Draft(text);
    for (const key of missing) {
      tried.add(key.name);
      draft.set([...table, key.name], startOf(key, owner?.type === "revolute"));
    }
    text = draft.apply();
  }
}

/** Of what a law misses without naming one key, such as where its stops are, the hint names those that would do. What all joints share is missed by any of them. A key with a default is not missing,
 *  even if its default does not go with another value. */
function misses(complaint: Complaint, owner: Owner, role: Role, key: CatalogKey): boolean {
  if (key.default) return false;
  const of = (name: string) => (owner ? complaint.key === `joint.${owner.name}.${name}` : complaint.key.startsWith("joint.") && complaint.key.endsWith(`.${name}`));
  if (of(role)) return key.otherwise !== undefined && key.name in STARTS && complaint.hint.includes(key.name);
  return of(key.name);
}

/** What keys begin with that have no default: on a length, and on an angle if that is another value. */
const STARTS: Readonly<Record<string, Literal | { slide: Literal; angle: Literal }>> = {
  clearance: "0.5 mm",
  pin_radius: "10 mm",
  backlash: "0.1 mm",
  contact_stiffness: 1e8,
  branch_ratio: [1],
  branch_time: ["0.1 s"],
  displacement: [0, "1 mm"],
  force: [0, "10 kN"],
  length: "100 mm",
  width: "20 mm",
  thickness: "0.5 mm",
  upper_stop: { slide: "100 mm", angle: "90 deg" },
  stop_stiffness: { slide: "1e6 N/m", angle: "1e4 N*m/rad" },
  stop_damping: { slide: "1e3 N*s/m", angle: "10 N*m*s/rad" },
  stop_cushion: { slide: "10 mm", angle: "5 deg" },
  ball_radius: "3 mm",
  notch_radius: "5 mm",
  notch_width: "5 mm",
  detent_preload: "20 N",
  detent_radius: "20 mm",
};

function startOf(key: CatalogKey, turns: boolean): Literal {
  const start = STARTS[key.name];
  if (start !== undefined) return typeof start === "object" && "slide" in start ? start[turns ? "angle" : "slide"] : start;
  const value = key.minimum && key.minimum > 0 ? key.minimum : 1e-3;
  const unit = (turns && key.angular_unit) || key.unit;
  const plainStart = unit && unit !== "-" ? `${value} ${unit}` : value;
  return key.list ? [plainStart] : plainStart;
}
