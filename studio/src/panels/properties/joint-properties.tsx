// Joints, springs, loads and motors: forms generated from the catalog and the schema.
import { drawn, edit, select } from "../../actions";
import type { Catalog, CatalogKey, PeakForce } from "../../kernel/protocol";
import { Draft } from "../../model/edit";
import type { Joint } from "../../model/model";
import { addMotor, addTorsionSpring } from "../../model/operations";
import { quantity } from "../../model/units";
import { player } from "../../play/player";
import { studio, useStudio } from "../../state";
import { estimateOf } from "../results/estimate";
import { Choice, Pair, TextQuantity, setLiteral, useLiteral } from "./fields";
import { type Field, fieldsOf, labelOf, useCatalog, useSchema } from "./form";
import { type Role, chooseDefaultFriction, chooseLaw } from "./law-choice";
import { Icon } from "../icons";

const TYPE_WORDS: Record<string, string> = {
  revolute: "pin", prismatic: "slider", fixed: "weld", slot: "pin in a slot", rod: "massless rod", rope: "rope", belt: "run of a belt", cylinder: "hydraulic or pneumatic cylinder", gear: "gear mesh", rack: "rack and pinion", cam: "cam and follower", edge: "roller on a curved edge",
};

export function JointProperties({ name }: { name: string }) {
  const joint = useStudio((now) => now.model.joints.find((one) => one.name === name));
  const answer = useStudio((now) => now.run.answer);
  const peak = answer?.joints.find((one) => one.name === name);
  const catalog = useCatalog();
  if (!joint) return null;
  const type = catalog?.joint_types.find((one) => one.word === joint.type);
  return (
    <>
      <p className="quiet">
        {TYPE_WORDS[joint.type] ?? joint.type} between <Ref name={joint.first.body} /> and <Ref name={joint.second.body} />
      </p>
      {peak && answer && <PeakLine peak={peak} estimate={estimateOf(peak, answer).about} />}
      <LawFields joint={joint} catalog={catalog} />
      {type && type.geometry.length > 0 && (
        <section>
          <h3>Geometry</h3>
          {joint.type === "gear" && <Pair label="Pitch radii" unit="m" path={["joint", name, "radii"]} names={["first", "second"]} />}
          <Keys keys={type.geometry} path={["joint", name]} />
          {joint.type === "gear" && <Mesh name={name} />}
        </section>
      )}
      {joint.type === "gear" && !type && <Pair label="Pitch radii" unit="m" path={["joint", name, "radii"]} names={["first", "second"]} />}
      {joint.profile && <ProfileFields joint={joint} />}
      {joint.type === "revolute" && <BearingFields name={name} />}
      <Additions joint={joint} />
    </>
  );
}

const PROFILE_KEYS: Record<string, readonly string[]> = { cam: ["lift", "base_radius", "follower", "roller_radius"], edge: ["height", "from", "to", "roller_radius"] };

function ProfileFields({ joint }: { joint: Joint }) {
  const schema = useSchema();
  return (
    <section>
      <h3>Profile</h3>
      <SchemaFields fields={fieldsOf(schema, "joint", false).filter((field) => PROFILE_KEYS[joint.type]?.includes(field.name))} path={["joint", joint.name]} />
    </section>
  );
}

/** Dimensions of the bearing, and its results from the last run. */
function BearingFields({ name }: { name: string }) {
  const schema = useSchema();
  const found = useStudio((now) => now.run.answer?.bearings?.find((one) => one.joint === name));
  return (
    <details>
      <summary data-tip="Life of a rolling bearing, pressure in a plain one. They do not change the motion.">Bearing</summary>
      <SchemaFields fields={fieldsOf(schema, "joint", false, "bearing")} path={["joint", name, "bearing"]} />
      {found && (
        <dl className="facts">
          <dt>Equivalent load</dt>
          <dd>{quantity(found.equivalent_load, "N")}</dd>
          <dt>Life L10h [h]</dt>
          <dd>{quantity(found.life_hours, "")}</dd>
          <dt>Static safety C0/F</dt>
          <dd>{quantity(found.static_safety, "")}</dd>
          <dt>Largest pressure</dt>
          <dd>{quantity(found.peak_pressure, "Pa")}</dd>
          <dt>Largest pv</dt>
          <dd>{quantity(found.peak_pv, "W/m^2")}</dd>
        </dl>
      )}
      {found && [...found.wants, ...found.remarks].map((text) => <p className="quiet" key={text}>{text}</p>)}
    </details>
  );
}

function Mesh({ name }: { name: string }) {
  const mesh = useLiteral(["joint", name, "mesh"]);
  return <Choice label="Mesh" value={String(mesh ?? "external")} options={["external", "internal"]} onChange={(value) => setLiteral(["joint", name, "mesh"], value, "Set mesh")} />;
}

function Ref({ name }: { name: string }) {
  if (name === "ground") return <b>the ground</b>;
  return (
    <button className="link-button inline" onClick={() => select([{ kind: "body", name }])}>
      {name}
    </button>
  );
}

function PeakLine({ peak, estimate }: { peak: PeakForce; estimate: string }) {
  const fresh = useStudio((now) => now.run.status === "done");
  return (
    <button className={fresh ? "peak-line" : "peak-line old"} data-tip="Go to the time of the largest force" onClick={() => player.seek(peak.peak_time)}>
      <span className="peak-value">{quantity(peak.peak, "N", 5)}</span>
      <span className="peak-about">
        largest force, at {quantity(peak.peak_time, "s")}
        <br />
        {estimate}
      </span>
    </button>
  );
}

/** The joint's resistance: the law's word and its numbers, with their units and defaults. */
function LawFields({ joint, catalog }: { joint: Joint; catalog: Catalog | null }) {
  const ideal = useLiteral(["joint", joint.name, "ideal"]);
  if (!catalog) return <p className="quiet">The laws are loading…</p>;
  const type = catalog.joint_types.find((one) => one.word === joint.type);
  const suits = catalog.laws.filter((law) => !type || type.laws.length === 0 || type.laws.includes(law.word));
  const allowed = suits.filter((law) => law.role === "law");
  const law = catalog.laws.find((one) => one.word === joint.law);
  const holds = !type || type.gap.length > 0;
  const turns = joint.type === "prismatic" || joint.type === "fixed";
  const keys = (law?.keys ?? []).filter((key) => turns || !key.name.startsWith("angular_"));
  return (
    <section>
      <h3 data-tip="Force of the joint against its deflection">Law</h3>
      {holds && (
        <>
          <Choice label="Law" value={joint.law} options={allowed.map((one) => ({ value: one.word, label: lawName(one.word) }))} onChange={(word) => void chooseLaw(catalog, joint, "law", word)} />
          {law && <p className="quiet">{law.meaning}</p>}
          {joint.law === "linear" && <Presets joint={joint} />}
          <Keys keys={keys} path={["joint", joint.name]} />
        </>
      )}
      <LawsBeside joint={joint} catalog={catalog} role="friction" label="Friction" suits={suits} />
      <LawsBeside joint={joint} catalog={catalog} role="stops" label="Stops" suits={suits} />
      <LawsBeside joint={joint} catalog={catalog} role="detent" label="Detent" suits={suits} />
      {holds && <label className="check">
        <input type="checkbox" checked={ideal === true} onChange={(event) => setLiteral(["joint", joint.name, "ideal"], event.target.checked ? true : null, "Ideal joint")} />
        <span data-tip='With equations "relative" (Model, Simulation), this joint is rigid'>Rigid (ideal)</span>
      </label>}
    </section>
  );
}

/** Friction, stops or a detent of the joint's free coordinate, in addition to its law. A joint that states nothing has the model's defaults. */
function LawsBeside({ joint, catalog, suits, role, label }: { joint: Joint; catalog: Catalog; suits: Catalog["laws"]; role: Exclude<Role, "law">; label: string }) {
  const word = useLiteral(["joint", joint.name, role]);
  const inherited = useLiteral(["defaults", "joint", role]);
  const laws = suits.filter((one) => one.role === role);
  if (laws.length === 0) return null;
  const unitsOf = (keys: readonly CatalogKey[]) => keys.map((key) => (joint.type === "revolute" && key.angular_unit ? { ...key, unit: key.angular_unit } : key));
  const fallback = laws.find((one) => one.word === inherited);
  const law = word === undefined ? fallback : laws.find((one) => one.word === word);
  const none = fallback ? [{ value: "", label: `${fallback.word} (default)` }, { value: "none", label: "none" }] : [{ value: "", label: "none" }];
  return (
    <>
      <Choice
        label={label}
        value={word === "none" && !fallback ? "" : String(word ?? "")}
        options={[...none, ...optionsOf(laws)]}
        onChange={(next) => void chooseLaw(catalog, joint, role, next)}
      />
      {law && <LawKeys law={{ ...law, keys: unitsOf(law.keys) }} path={["joint", joint.name]} />}
    </>
  );
}

const optionsOf = (laws: Catalog["laws"]) => laws.map((one) => ({ value: one.word, label: one.word }));

function LawKeys({ law, path }: { law: Catalog["laws"][number]; path: readonly string[] }) {
  return (
    <>
      <p className="quiet">{law.meaning}</p>
      <Keys keys={law.keys} path={path} />
    </>
  );
}

const lawName = (word: string) => (word === "linear" ? "linear (stiffness and damping)" : word.replace(/_/g, " "));

/** Typical values of real joints. */
const PRESETS: { label: string; tip: string; stiffness: string; damping: string }[] = [
  { label: "Stiff", tip: "Nearly ideal: 1e10 N/m", stiffness: "1e10 N/m", damping: "1e5 N*s/m" },
  { label: "Bearing", tip: "A rolling-element bearing: 2e8 N/m", stiffness: "2e8 N/m", damping: "3500 N*s/m" },
  { label: "Journal", tip: "A lubricated journal: 5e7 N/m, heavily damped", stiffness: "5e7 N/m", damping: "2e5 N*s/m" },
  { label: "Bushing", tip: "A rubber bushing: 5e5 N/m", stiffness: "5e5 N/m", damping: "500 N*s/m" },
];

function Presets({ joint }: { joint: Joint }) {
  const stiffness = useLiteral(["joint", joint.name, "stiffness"]);
  const apply = (one: (typeof PRESETS)[number]) => {
    const draft = new Draft(studio.get().model.document);
    draft.set(["joint", joint.name, "stiffness"], one.stiffness).set(["joint", joint.name, "damping"], one.damping);
    edit(draft.apply(), `${one.label} in ${joint.name}`);
  };
  return (
    <div className="presets" role="group" aria-label="Typical values">
      {PRESETS.map((one) => (
        <button key={one.label} className={stiffness === one.stiffness ? "chip on" : "chip"} aria-pressed={stiffness === one.stiffness} data-tip={one.tip} onClick={() => apply(one)}>
          {one.label}
        </button>
      ))}
    </div>
  );
}

/** Dry friction of every joint that can have it, unless the joint says otherwise. */
export function DefaultFriction({ catalog }: { catalog: Catalog | null }) {
  const word = useLiteral(["defaults", "joint", "friction"]);
  const laws = catalog?.laws.filter((one) => one.role === "friction") ?? [];
  if (!catalog || laws.length === 0) return null;
  const law = laws.find((one) => one.word === word);
  return (
    <>
      <Choice
        label="Friction"
        meaning="Dry friction of all joints that can have it, unless they say otherwise"
        value={law?.word ?? ""}
        options={[{ value: "", label: "none" }, ...optionsOf(laws)]}
        onChange={(next) => void chooseDefaultFriction(catalog, next)}
      />
      {law && <LawKeys law={law} path={["defaults", "joint"]} />}
    </>
  );
}

function Keys({ keys, path }: { keys: readonly CatalogKey[]; path: readonly string[] }) {
  const defaults = useLiteral(["defaults", "joint"]);
  const own = typeof defaults === "object" && !Array.isArray(defaults) ? defaults : {};
  return (
    <>
      {keys.some((key) => key.list) && <p className="quiet">{keys.filter((key) => key.list).map((key) => labelOf(key.name)).join(" and ")}: lists, edited in the text.</p>}
      {keys.filter((key) => key.words).map((key) => (
        <SchemaField key={key.name} field={{ ...key, kind: "word", fallback: String(key.default), required: false }} path={[...path, key.name]} />
      ))}
      {keys.filter((key) => !key.list && !key.words).map((key) => (
        <TextQuantity
          key={key.name}
          label={labelOf(key.name)}
          unit={key.unit === "-" ? "" : key.unit}
          path={[...path, key.name]}
          meaning={key.meaning}
          fallback={own[key.name] !== undefined ? `${String(own[key.name])}` : key.default !== undefined ? String(key.default) : key.otherwise}
        />
      ))}
    </>
  );
}

function Additions({ joint }: { joint: Joint }) {
  const model = useStudio((now) => now.model);
  const motor = model.motors.find((one) => one.joint === joint.name);
  const turns = joint.type === "revolute";
  if (!turns && joint.type !== "prismatic" && joint.type !== "slot") return null;
  return (
    <section className="row-buttons">
      {motor ? (
        <button className="button" onClick={() => select([{ kind: "motor", name: motor.name }])}>
          <Icon name="motor" size={17} /> {motor.name}
        </button>
      ) : (
        <button className="button" onClick={() => drawn(addMotor(studio.get().model, joint.name), "Motor")}>
          <Icon name="motor" size={17} /> Add a motor
        </button>
      )}
      {turns && (
        <button className="button" onClick={() => drawn(addTorsionSpring(studio.get().model, joint.name), "Torsion spring")}>
          <Icon name="torsion" size={17} /> Torsion spring
        </button>
      )}
    </section>
  );
}

function SchemaFields({ fields, path, variables }: { fields: readonly Field[]; path: readonly string[]; variables?: boolean }) {
  return (
    <>
      {fields.map((field) => (
        <SchemaField key={field.name} field={field} path={[...path, field.name]} variables={variables} />
      ))}
    </>
  );
}

export function SchemaField({ field, path, variables }: { field: Field; path: readonly string[]; variables?: boolean }) {
  const literal = useLiteral(path);
  if (field.kind === "word") {
    const options = [...(field.required ? [] : [{ value: "", label: `${field.fallback ?? "–"} (default)` }]), ...(field.words ?? [])];
    return <Choice label={labelOf(field.name)} value={field.synonyms?.[String(literal)] ?? String(literal ?? "")} options={options} meaning={field.meaning} onChange={(value) => setLiteral(path, value || null, `Set ${labelOf(field.name).toLowerCase()}`)} />;
  }
  if (field.kind === "pair") return <Pair label={labelOf(field.name)} unit={field.unit} path={path} names={["x", "y"]} meaning={field.meaning} variables={variables} />;
  if (field.kind !== "quantity" && field.kind !== "expression") return null;
  return <TextQuantity label={labelOf(field.name)} unit={field.unit} path={path} meaning={field.meaning} fallback={field.fallback} variables={variables && field.kind === "expression"} />;
}

export function SpringProperties({ name, table }: { name: string; table: "spring" | "torsion_spring" }) {
  const schema = useSchema();
  const spring = useStudio((now) => now.model.springs.find((one) => one.name === name && one.torsion === (table === "torsion_spring")));
  if (!spring) return null;
  return (
    <section>
      <p className="quiet">
        between <Ref name={spring.first.body} /> and <Ref name={spring.second.body} />
      </p>
      <SchemaFields fields={fieldsOf(schema, table).filter((field) => field.name !== "between")} path={[table, name]} />
    </section>
  );
}

export function LoadProperties({ name }: { name: string }) {
  const schema = useSchema();
  const load = useStudio((now) => now.model.loads.find((one) => one.name === name));
  if (!load) return null;
  return (
    <section>
      <p className="quiet">
        at {load.on.marker} of <Ref name={load.on.body} />. Values may be expressions of <code>t</code>.
      </p>
      <SchemaFields fields={fieldsOf(schema, "force").filter((field) => field.name !== "on")} path={["force", name]} variables />
    </section>
  );
}

const EFFORTS = ["speed", "position", "torque", "force"];

export function MotorProperties({ name }: { name: string }) {
  const schema = useSchema();
  const motor = useStudio((now) => now.model.motors.find((one) => one.name === name));
  const joint = useStudio((now) => now.model.joints.find((one) => one.name === motor?.joint));
  const work = useStudio((now) => now.run.answer?.motors.find((one) => one.name === name));
  if (!motor) return null;
  const slides = joint?.type === "prismatic" || joint?.type === "slot";
  const fields = fieldsOf(schema, "motor", slides);
  const effort = slides ? "force" : "torque";
  const law = motor.kind === "effort" ? effort : motor.kind;
  const change = (to: string) => {
    const draft = new Draft(studio.get().model.document);
    for (const word of EFFORTS) if (word !== to) draft.remove(["motor", name, word]);
    const start: Record<string, string> = slides ? { speed: "0.1 m/s", position: "0.05 m*sin(2*pi*t)", force: "10 N" } : { speed: "60 rpm", position: "0.5 rad*sin(2*pi*t)", torque: "1 N*m" };
    draft.set(["motor", name, to], start[to] ?? "0");
    edit(draft.apply(), `Drive of ${name}`);
  };
  const shown = fields.filter((field) => field.name === law || (motor.kind !== "effort" && (field.name === "stiffness" || field.name === "damping")));
  return (
    <section>
      <p className="quiet">
        in joint{" "}
        <button className="link-button inline" onClick={() => select([{ kind: "joint", name: motor.joint }])}>
          {motor.joint}
        </button>
      </p>
      <Choice label="Controls" value={law} options={["speed", "position", effort]} meaning="A servo with the stiffness below holds speed or position; a torque is applied directly" onChange={change} />
      {shown.map((field) => (
        <SchemaField key={field.name} field={field.name === law ? { ...field, kind: "expression", fallback: undefined } : field} path={["motor", name, field.name]} variables />
      ))}
      {work && (
        <dl className="facts">
          <dt>Largest {effort}</dt>
          <dd>{quantity(work.peak_effort, work.unit)}</dd>
          <dt>Largest power</dt>
          <dd>{quantity(work.peak_power, "W")}</dd>
          <dt>Work</dt>
          <dd>{quantity(work.work, "J")}</dd>
        </dl>
      )}
    </section>
  );
}
