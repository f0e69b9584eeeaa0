// Chooses another law of a joint, or other friction, stops or detent in addition to it: adds a value for each key that is required, and removes those
// that only the former law had. The kernel determines the required keys: they depend on the joint, and on the model's defaults.
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

/** An empty word removes the law of this role, or leaves it to the model's defaults. One undo step. */
export async function chooseLaw(catalog: Catalog, joint: Joint, role: Role, word: string): Promise<void> {
  const stated = (at: Role) => (at === "law" ? find(catalog, at, joint.law) : (statedLaw(catalog, at, joint) ?? statedLaw(catalog, at, null)));
  await choose(catalog, joint, role, word, stated(role), ROLES.filter((one) => one !== role).map(stated));
}

/** Dry friction of all joints that can have it; an empty word removes it. One undo step. */
export async function chooseDefaultFriction(catalog: Catalog, word: string): Promise<void> {
  const others = studio.get().model.joints.flatMap((joint) => [find(catalog, "law", joint.law), statedLaw(catalog, "friction", joint)]);
  await choose(catalog, null, "friction", word, statedLaw(catalog, "friction", null), others);
}

/** The owner of the law: a joint, or null for all joints that state none. */
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
  // Values that no longer belong to any law would be errors.
  for (const { name } of before?.keys ?? []) if (keys.every((one) => one.name !== name)) draft.remove([...table, name]);
  if (word) draft.set([...table, role], word);
  else draft.remove([...table, role]);
  const text = law ? await withMissingKeys(draft.apply(), owner, law) : draft.apply();
  if (studio.get().model.document !== document) return; // the answer came too late: the text has changed
  edit(text, `${role.charAt(0).toUpperCase()}${role.slice(1)} of ${owner?.name ?? "all joints"}`);
}

/** Adds the keys of the law that the kernel reports as missing. It asks repeatedly, because some are missing only when others are present. */
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

/** If a law lacks something but no single key, such as the positions of its stops, the hint names the possible keys. A key shared by all joints is missing if any joint lacks it. A key with a default is not missing,
 * even if its default is inconsistent with another value. */
function misses(complaint: Complaint, owner: Owner, role: Role, key: CatalogKey): boolean {
  if (key.default) return false;
  const of = (name: string) => (owner ? complaint.key === `joint.${owner.name}.${name}` : complaint.key.startsWith("joint.") && complaint.key.endsWith(`.${name}`));
  if (of(role)) return key.otherwise !== undefined && key.name in STARTS && complaint.hint.includes(key.name);
  return of(key.name);
}

/** Start values of keys without a default: for a length, and for an angle if that is different. */
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
