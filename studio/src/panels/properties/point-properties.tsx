// A point of a link or of the ground: its position, and the direction of its axis.
import { place } from "../../actions";
import { GROUND, worldPoint } from "../../model/model";
import { movePoint } from "../../model/reshape";
import { writeLength } from "../../model/units";
import { studio, useStudio } from "../../state";
import { ComputedQuantity } from "./fields";

export function PointProperties({ name }: { name: string }) {
  const model = useStudio((now) => now.model);
  const poses = useStudio((now) => now.poses) ?? undefined;
  const [body = "", marker = ""] = name.split(".");
  const end = { body, marker };
  const at = worldPoint(model, end, poses);
  const set = (i: 0 | 1) => (metres: number) => place(movePoint(studio.get().model, end, i === 0 ? [metres, at[1]] : [at[0], metres], poses), `Move ${marker}`);
  return (
    <section>
      <p className="quiet">
        Point <b>{marker}</b> of {body === GROUND ? "the ground" : body}. Whatever is pinned here moves with it.
      </p>
      <ComputedQuantity label="x" unit="m" literal={writeLength(at[0], 6)} meaning="In the world, at the start" onChange={set(0)} />
      <ComputedQuantity label="y" unit="m" literal={writeLength(at[1], 6)} meaning="In the world, at the start" onChange={set(1)} />
    </section>
  );
}
