// A point of a link or of the ground: its position, and the direction of its axis.
import { place } from "../../actions";
import { evaluate } from "../../model/expression";
import type { Literal } from "../../model/edit";
import { GROUND, worldPoint } from "../../model/model";
import { movePoint } from "../../model/reshape";
import { writeLength } from "../../model/units";
import { studio, useStudio } from "../../state";
import { Quantity } from "./fields";

export function PointProperties({ name }: { name: string }) {
  const model = useStudio((now) => now.model);
  const poses = useStudio((now) => now.poses) ?? undefined;
  const [body = "", marker = ""] = name.split(".");
  const end = { body, marker };
  const at = worldPoint(model, end, poses);
  const set = (i: 0 | 1) => (literal: Literal | null) => {
    const metres = typeof literal === "number" ? literal : evaluate(String(literal ?? ""), (word) => model.parameters.get(word));
    if (metres === null) return;
    place(movePoint(studio.get().model, end, i === 0 ? [metres, at[1]] : [at[0], metres], poses), `Move ${marker}`);
  };
  return (
    <section>
      <p className="quiet">
        Point <b>{marker}</b> of {body === GROUND ? "the ground" : body}. Whatever is pinned here moves with it.
      </p>
      <Quantity label="x" unit="m" literal={writeLength(at[0], 6)} required meaning="In the world, at the start" onChange={set(0)} />
      <Quantity label="y" unit="m" literal={writeLength(at[1], 6)} required meaning="In the world, at the start" onChange={set(1)} />
    </section>
  );
}
