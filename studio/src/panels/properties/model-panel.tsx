// The model as a whole: parameters, gravity, run settings.
import { useState } from "react";
import { edit } from "../../actions";
import { Draft } from "../../model/edit";
import { quantity, shortNumber } from "../../model/units";
import { studio, useStudio } from "../../state";
import { Pair, Quantity, TextQuantity, setLiteral, useLiteral } from "./fields";
import { type Field, fieldsOf, labelOf, useCatalog, useSchema } from "./form";
import { Icon } from "../icons";
import { DefaultFriction, SchemaField } from "./joint-properties";

export function ModelPanel() {
  return (
    <div className="properties">
      <Simulation />
      <Gravity />
      <Parameters />
      <JointDefaults />
      <Facts />
    </div>
  );
}

const SIMPLE = new Set(["duration", "output_step", "tolerance"]);

function Simulation() {
  const schema = useSchema();
  const fields = fieldsOf(schema, "simulate").filter((field) => field.kind !== "words");
  const show = (field: Field) => <SchemaField key={field.name} field={field} path={["simulate", field.name]} />;
  return (
    <section>
      <h3>Simulation</h3>
      {fields.length === 0 && <TextQuantity label="Duration" unit="s" path={["simulate", "duration"]} />}
      {fields.filter((field) => SIMPLE.has(field.name)).map(show)}
      <details>
        <summary>Method and start</summary>
        {fields.filter((field) => !SIMPLE.has(field.name)).map(show)}
      </details>
    </section>
  );
}

function Gravity() {
  const literal = useLiteral(["gravity"]);
  const on = !(Array.isArray(literal) && literal.every((part) => part === 0));
  return (
    <section>
      <h3>Gravity</h3>
      <label className="check">
        <input type="checkbox" checked={on} onChange={(event) => setLiteral(["gravity"], event.target.checked ? null : [0, 0], "Gravity")} />
        <span>Gravity acts</span>
      </label>
      {on && <Pair label="Acceleration" unit="m/s^2" path={["gravity"]} names={["x", "y"]} fallback={[0, -9.80665]} />}
    </section>
  );
}

function Parameters() {
  const literal = useLiteral(["parameters"]);
  const entries = typeof literal === "object" && !Array.isArray(literal) ? Object.entries(literal) : [];
  const [name, setName] = useState("");
  const taken = entries.some(([key]) => key === name);
  const valid = /^[A-Za-z_]\w*$/.test(name) && !taken;
  const add = () => {
    if (!valid) return;
    edit(new Draft(studio.get().model.document).set(["parameters", name], 1).apply(), `Parameter ${name}`);
    setName("");
  };
  return (
    <section>
      <h3 data-tip="Named numbers for use in any field: 2*crank + 5 mm">Parameters</h3>
      {entries.length === 0 && <p className="quiet">A parameter is a named number. Any field takes expressions of parameters, such as 2*crank + 5 mm.</p>}
      {entries.map(([key, value]) => (
        <div className="parameter" key={key}>
          <Quantity label={key} unit="" literal={value} required onChange={(next) => next !== null && setLiteral(["parameters", key], next, `Set ${key}`)} />
          <button className="icon-button small" aria-label={`Delete ${key}`} onClick={() => setLiteral(["parameters", key], null, `Delete ${key}`)}>
            <Icon name="trash" size={15} />
          </button>
        </div>
      ))}
      <div className="parameter add">
        <input aria-label="Name of a new parameter" placeholder="new_parameter" value={name} spellCheck={false} onChange={(event) => setName(event.target.value)} onKeyDown={(event) => event.key === "Enter" && add()} />
        <button className="button" disabled={!valid} onClick={add}>
          <Icon name="plus" size={16} /> Add
        </button>
      </div>
    </section>
  );
}

const LAW_UNITS: [string, string, string][] = [
  ["stiffness", "N/m", "1e8"],
  ["damping", "N*s/m", "3000"],
  ["angular_stiffness", "N*m/rad", "1e6"],
  ["angular_damping", "N*m*s/rad", "30"],
];

function JointDefaults() {
  const catalog = useCatalog();
  return (
    <details>
      <summary data-tip="For joints without values of their own">Defaults of all joints</summary>
      {LAW_UNITS.map(([name, unit, fallback]) => (
        <TextQuantity key={name} label={labelOf(name)} unit={unit} path={["defaults", "joint", name]} fallback={fallback} />
      ))}
      <DefaultFriction catalog={catalog} />
    </details>
  );
}

function Facts() {
  const report = useStudio((now) => now.report);
  if (!report) return null;
  const { mobility } = report;
  return (
    <section>
      <h3>What it is</h3>
      <dl className="facts">
        <dt>Links, joints</dt>
        <dd>
          {report.bodies}, {report.joints}
        </dd>
        <dt>Closed loops</dt>
        <dd>{report.topology.n_loops}</dd>
        <dt data-tip="Independent motions, before motors act">Degrees of freedom</dt>
        <dd>{mobility.mobility}</dd>
        <dt data-tip="Ideal joints would leave the load sharing undetermined">Redundant constraints</dt>
        <dd>{mobility.redundant}</dd>
        <dt>Total mass</dt>
        <dd>{quantity(report.total_mass, "kg")}</dd>
        <dt>Centre of mass</dt>
        <dd>
          {shortNumber(report.mass_centre[0] * 1e3)}, {shortNumber(report.mass_centre[1] * 1e3)} mm
        </dd>
      </dl>
    </section>
  );
}
