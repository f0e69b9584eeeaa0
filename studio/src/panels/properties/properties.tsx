// The selection and all its properties.
import { edit, meshSelection, removeSelection, select } from "../../actions";
import { type Model, gearRadius } from "../../model/model";
import { NAME, type Kind, namesOf } from "../../model/names";
import type { Thing } from "../../model/operations";
import { renameThing } from "../../model/removal";
import { studio, useStudio } from "../../state";
import { BodyProperties } from "./body-properties";
import { NameField } from "./fields";
import { Icon } from "../icons";
import { JointProperties, LoadProperties, MotorProperties, SpringProperties } from "./joint-properties";
import { PointProperties } from "./point-properties";

const TITLES: Record<Thing["kind"], string> = {
  body: "Link",
  joint: "Joint",
  spring: "Spring",
  torsion_spring: "Torsion spring",
  force: "Load",
  motor: "Motor",
  marker: "Point",
  ground: "Ground",
};

export function Properties() {
  const selection = useStudio((now) => now.selection);
  const model = useStudio((now) => now.model);
  const only = selection.length === 1 ? selection[0] : undefined;
  if (!only) return selection.length > 1 ? <Many selection={selection} model={model} /> : <Contents model={model} />;
  return (
    <div className="properties" key={`${only.kind}.${only.name}`}>
      <div className="title-row">
        <h2>{TITLES[only.kind]}</h2>
        <button className="icon-button small" aria-label={`Delete ${only.name}`} data-tip="Delete  Del" onClick={removeSelection}>
          <Icon name="trash" size={17} />
        </button>
      </div>
      {only.kind !== "marker" && only.kind !== "ground" && <Renaming kind={only.kind} name={only.name} />}
      {only.kind === "body" && <BodyProperties name={only.name} />}
      {only.kind === "joint" && <JointProperties name={only.name} />}
      {only.kind === "spring" && <SpringProperties name={only.name} table="spring" />}
      {only.kind === "torsion_spring" && <SpringProperties name={only.name} table="torsion_spring" />}
      {only.kind === "force" && <LoadProperties name={only.name} />}
      {only.kind === "motor" && <MotorProperties name={only.name} />}
      {only.kind === "marker" && <PointProperties name={only.name} />}
    </div>
  );
}

function Renaming({ kind, name }: { kind: Kind; name: string }) {
  const check = (to: string): string => {
    if (!NAME.test(to)) return "A name has letters, digits, _ and - only.";
    return namesOf(studio.get().model, kind).has(to) ? `${to} already exists.` : "";
  };
  const rename = (to: string) => {
    if (edit(renameThing(studio.get().model, kind, name, to), `Rename ${name}`)) select([{ kind, name: to }]);
  };
  return <NameField label="Name" value={name} check={check} onChange={rename} />;
}

function Many({ selection, model }: { selection: readonly Thing[]; model: Model }) {
  const bodies = selection.map((thing) => (thing.kind === "body" ? model.body.get(thing.name) : undefined));
  const gears = bodies.length === 2 && bodies.every((body) => body && gearRadius(model, body) !== null);
  return (
    <div className="properties">
      <h2>{selection.length} things</h2>
      <p className="quiet">Copy, duplicate or delete them; arrow keys move links.</p>
      {gears && (
        <button className="button" onClick={meshSelection}>
          <Icon name="disc" size={17} /> Mesh these gears
        </button>
      )}
      <button className="button" onClick={removeSelection}>
        <Icon name="trash" size={17} /> Delete
      </button>
    </div>
  );
}

/** If nothing is selected: everything in the model, to choose from. */
function Contents({ model }: { model: Model }) {
  const groups: [string, Kind, { name: string; about: string }[]][] = [
    ["Links", "body", model.bodies.map((one) => ({ name: one.name, about: `${Number(one.mass.toPrecision(3))} kg` }))],
    ["Joints", "joint", model.joints.map((one) => ({ name: one.name, about: one.type }))],
    ["Springs", "spring", model.springs.filter((one) => !one.torsion).map((one) => ({ name: one.name, about: "" }))],
    ["Torsion springs", "torsion_spring", model.springs.filter((one) => one.torsion).map((one) => ({ name: one.name, about: "" }))],
    ["Loads", "force", model.loads.map((one) => ({ name: one.name, about: one.on.body }))],
    ["Motors", "motor", model.motors.map((one) => ({ name: one.name, about: `in ${one.joint}` }))],
  ];
  const filled = groups.filter(([, , list]) => list.length > 0);
  if (filled.length === 0) return <p className="quiet">Nothing is drawn yet. What you draw and select shows its properties here.</p>;
  return (
    <div className="properties">
      {filled.map(([title, kind, list]) => (
        <section key={title}>
          <h3>{title}</h3>
          <ul className="things">
            {list.slice(0, 400).map((one) => (
              <li key={one.name}>
                <button
                  onClick={() => select([{ kind, name: one.name }])}
                  onPointerEnter={() => studio.set({ hover: { kind, name: one.name } })}
                  onPointerLeave={() => studio.set({ hover: null })}
                >
                  <span>{one.name}</span>
                  <span className="about">{one.about}</span>
                </button>
              </li>
            ))}
          </ul>
        </section>
      ))}
    </div>
  );
}
