// A link: its size, its shape and material, and the values derived from them unless they are stated.
import { edit, place, select } from "../../actions";
import { Draft } from "../../model/edit";
import { type Body, markerOf, poseOf } from "../../model/model";
import { toggleTrace } from "../../model/operations";
import { applyShape, barLength, setBarAngle, setBarLength } from "../../model/reshape";
import { MATERIALS, type Shape, likelyBar, writeShape } from "../../model/shape";
import { direction, toWorld } from "../../model/geometry";
import { writeAngle, writeLength } from "../../model/units";
import { studio, useStudio } from "../../state";
import { Choice, ComputedQuantity, Pair, TextQuantity } from "./fields";
import { Icon } from "../icons";

export function BodyProperties({ name }: { name: string }) {
  const body = useStudio((now) => now.model.body.get(name));
  if (!body) return null;
  return (
    <>
      <Size body={body} />
      <ShapeFields body={body} />
      <section>
        <h3>Mass</h3>
        <TextQuantity label="Mass" unit="kg" path={["body", name, "mass"]} required meaning="A typed value overrides the shape" note={body.massFromShape ? <FromShape /> : null} />
        <TextQuantity label="Inertia" unit="kg*m^2" path={["body", name, "inertia"]} required meaning="Moment of inertia about the centre of mass" note={body.inertiaFromShape ? <FromShape /> : null} />
        {body.shape && (!body.massFromShape || !body.inertiaFromShape) && (
          <button className="link-button" onClick={() => reshape(body, body.shape!)}>
            Compute both from the shape again
          </button>
        )}
      </section>
      <details>
        <summary>Start: position and speed</summary>
        <Pair label="Centre of mass" unit="m" path={["body", name, "position"]} names={["x", "y"]} meaning="A guess: assembly closes the mechanism from here" />
        <TextQuantity label="Angle" unit="rad" path={["body", name, "angle"]} meaning="Of the link's axes at the start" />
        <Pair label="Velocity" unit="m/s" path={["body", name, "velocity"]} names={["x", "y"]} meaning="Of the centre of mass at the start; empty: found by assembly" />
        <TextQuantity label="Spin" unit="rad/s" path={["body", name, "spin"]} fallback="found by assembly" meaning="Angular velocity at the start" />
      </details>
      <Points body={body} />
    </>
  );
}

function FromShape() {
  return (
    <span className="tag" data-tip="Computed from shape and material; type a number to override it">
      from shape
    </span>
  );
}

function Size({ body }: { body: Body }) {
  const poses = useStudio((now) => now.poses) ?? undefined;
  const length = barLength(body);
  const [a, b] = body.markers;
  if (length === null || !a || !b) return null;
  const pose = poseOf(studio.get().model, body.name, poses);
  const angle = direction(toWorld(pose, a.at), toWorld(pose, b.at));
  const setLength = (metres: number) => place(setBarLength(studio.get().model, body.name, metres, poses), `Length of ${body.name}`);
  const setAngle = (radians: number) => place(setBarAngle(studio.get().model, body.name, radians, poses), `Angle of ${body.name}`);
  return (
    <section>
      <h3>
        Size <span className="about">{`from ${a.name} to ${b.name}`}</span>
      </h3>
      <ComputedQuantity label="Length" unit="m" positive literal={writeLength(length, 6)} meaning={`Distance from ${a.name} to ${b.name}`} onChange={setLength} />
      <ComputedQuantity label="Angle" unit="rad" literal={writeAngle(angle, 4)} meaning="From the horizontal, at the start" onChange={setAngle} />
    </section>
  );
}

function reshape(body: Body, shape: Shape): void {
  const { model, poses } = studio.get();
  const draft = new Draft(model.document);
  applyShape(draft, { ...body, shape }, poseOf(model, body.name, poses ?? undefined));
  draft.shape(body.name, writeShape(shape));
  edit(draft.apply(), `Shape of ${body.name}`);
}

function ShapeFields({ body }: { body: Body }) {
  const { shape } = body;
  if (!shape) {
    const begin = () => reshape({ ...body, massFromShape: true, inertiaFromShape: true }, likelyBar(barLength(body) ?? 0.1));
    return (
      <section>
        <h3>Shape</h3>
        <p className="quiet">Mass and inertia are stated as numbers.</p>
        <button className="link-button" onClick={begin}>
          Compute them from a shape and a material
        </button>
      </section>
    );
  }
  const set = (change: Partial<Shape>) => reshape(body, { ...shape, ...change });
  const size = (key: "width" | "height" | "thickness") => (metres: number) => set({ [key]: metres });
  return (
    <section>
      <h3>Shape</h3>
      <Choice label="Shape" value={shape.kind} options={[{ value: "bar", label: "bar or plate" }, "block", "disc"]} onChange={(kind) => set({ kind: kind as Shape["kind"] })} />
      <Choice label="Material" value={shape.material} options={Object.entries(MATERIALS).map(([word, density]) => ({ value: word, label: `${word}, ${density} kg/m³` }))} onChange={(material) => set({ material })} />
      <ComputedQuantity label={shape.kind === "disc" ? "Diameter" : "Width"} unit="m" positive literal={writeLength(shape.width, 6)} onChange={size("width")} />
      {shape.kind === "block" && <ComputedQuantity label="Height" unit="m" positive literal={writeLength(shape.height, 6)} onChange={size("height")} />}
      <ComputedQuantity label="Thickness" unit="m" positive literal={writeLength(shape.thickness, 6)} onChange={size("thickness")} />
    </section>
  );
}

function Points({ body }: { body: Body }) {
  const trace = (marker: string) => {
    const { model } = studio.get();
    const end = { body: body.name, marker };
    edit(toggleTrace(model, { at: markerOf(model, end)?.at ?? [0, 0], end, body: body.name }).text, `Trace ${marker}`);
  };
  return (
    <section>
      <h3>Points</h3>
      <ul className="things">
        {body.markers.map((marker) => (
          <li key={marker.name} className="point-row">
            <button onClick={() => select([{ kind: "marker", name: `${body.name}.${marker.name}` }])}>{marker.name}</button>
            <button className={marker.traced ? "icon-button small on" : "icon-button small"} aria-pressed={marker.traced} aria-label={`Trace the path of ${marker.name}`} data-tip="Draw the curve of this point" onClick={() => trace(marker.name)}>
              <Icon name="trace" size={17} />
            </button>
          </li>
        ))}
      </ul>
    </section>
  );
}
