// What is wrong, where, and what to do about it: from the text, the assembly, the check and the run.
import { edit, editText, select } from "../../actions";
import type { Warning } from "../../kernel/protocol";
import { Draft } from "../../model/edit";
import { removeThings } from "../../model/removal";
import { player } from "../../play/player";
import { type StudioState, studio, useStudio } from "../../state";
import { quantity } from "../../model/units";
import { Icon } from "../icons";
import { useMemo } from "react";

export interface Problem {
  severity: "error" | "warning" | "note";
  title: string;
  hint: string;
  where?: { line: number; column: number };
  fixes: { label: string; run: () => void }[];
}

export function useProblems(): Problem[] {
  const complaints = useStudio((now) => now.complaints);
  const obstacle = useStudio((now) => now.obstacle);
  const report = useStudio((now) => now.report);
  const run = useStudio((now) => now.run);
  const model = useStudio((now) => now.model);
  return useMemo(() => collect({ complaints, obstacle, report, run, model }), [complaints, obstacle, report, run, model]);
}

function collect({ complaints, obstacle, report, run, model }: Pick<StudioState, "complaints" | "obstacle" | "report" | "run" | "model">): Problem[] {
  const list: Problem[] = complaints.map((one) => ({
    severity: one.severity,
    title: one.key ? `${one.key}: ${one.message}` : one.message,
    hint: one.hint,
    where: one.line > 0 ? { line: one.line, column: one.column } : undefined,
    fixes: [...suggestion(one), ...(one.line > 0 ? [{ label: `Show line ${one.line}`, run: () => showLine(one.line, one.column) }] : [])],
  }));
  if (list.some((one) => one.severity === "error")) return list;
  if (obstacle && model.bodies.length > 0) list.push({ severity: "error", title: obstacle.message, hint: obstacle.hint, fixes: [...showJoints(obstacle.joints ?? [])] });
  if (run.fault && run.fault.message !== obstacle?.message) {
    const noDuration = model.duration === null;
    list.push({ severity: "error", title: run.fault.message, hint: run.fault.hint, fixes: noDuration ? [{ label: "Run 2 seconds", run: setDuration }] : showJoints(run.fault.joints ?? []) });
  }
  const { answer } = run;
  if (answer?.stopped) {
    const { time, reason, hint, joints } = answer.stopped;
    list.push({ severity: "error", title: `The run stopped at ${quantity(time, "s")}: ${reason}`, hint, fixes: [{ label: "Go to that time", run: () => player.seek(time) }, ...showJoints(joints)] });
  } else if (answer?.outcome === "horizon") {
    list.push({ severity: "note", title: `Chaotic motion: ${answer.message}.`, hint: "The motion after that is one of many possible ones; a smaller tolerance gains little.", fixes: [] });
  } else if (answer?.outcome === "tolerance_not_met") {
    list.push({ severity: "warning", title: "A joint force misses the tolerance.", hint: "Peak forces shows each estimate. Impacts and very soft joints need a smaller tolerance or a shorter max step.", fixes: [] });
  }
  for (const warning of report?.warnings ?? []) if (warning.kind !== "note") list.push(fromWarning(warning));
  for (const note of [...(answer?.notes ?? []), ...(report?.warnings ?? []).filter((one) => one.kind === "note").map((one) => one.message)]) {
    list.push({ severity: "note", title: note, hint: "", fixes: [] });
  }
  return list;
}

function fromWarning(warning: Warning): Problem {
  const fixes = [...showJoints(warning.joints), ...warning.bodies.slice(0, 1).map((name) => ({ label: `Show ${name}`, run: () => select([{ kind: "body", name }]) }))];
  const last = warning.joints[warning.joints.length - 1];
  if (warning.kind === "immobile" && last) fixes.push({ label: `Remove joint ${last}`, run: () => remove("joint", last) });
  if (warning.kind === "driven") {
    const motor = studio.get().model.motors[studio.get().model.motors.length - 1];
    if (motor) fixes.push({ label: `Remove motor ${motor.name}`, run: () => remove("motor", motor.name) });
  }
  return { severity: "warning", title: warning.message, hint: warning.hint, fixes };
}

function remove(kind: "joint" | "motor", name: string): void {
  edit(removeThings(studio.get().model, [{ kind, name }]), `Remove ${name}`);
}

function showJoints(joints: readonly string[]): Problem["fixes"] {
  if (joints.length === 0) return [];
  const label = joints.length === 1 ? `Show joint ${joints[0]}` : `Show joints ${joints.slice(0, 4).join(", ")}${joints.length > 4 ? ", …" : ""}`;
  return [{ label, run: () => select(joints.map((name) => ({ kind: "joint", name }))) }];
}

function setDuration(): void {
  edit(new Draft(studio.get().model.document).set(["simulate", "duration"], "2 s").apply(), "Set duration");
}

// 'did you mean "revolute"?' for a value of the text: the value can be replaced immediately.
function suggestion(complaint: { hint: string; line: number; column: number; length: number }): Problem["fixes"] {
  const word = /did you mean "([^"]+)"/.exec(complaint.hint)?.[1];
  if (!word || complaint.line <= 0) return [];
  return [{ label: `Write "${word}"`, run: () => replaceAt(complaint.line, complaint.column, word) }];
}

function replaceAt(line: number, column: number, word: string): void {
  const { text } = studio.get().history;
  const lines = text.split("\n");
  const row = lines[line - 1] ?? "";
  const rest = row.slice(column - 1);
  const found = /^"[^"]*"|^[\w-]+/.exec(rest)?.[0];
  if (!found) return;
  const quoted = found.startsWith('"') ? JSON.stringify(word) : word;
  lines[line - 1] = row.slice(0, column - 1) + quoted + rest.slice(found.length);
  editText(lines.join("\n"), `Write ${word}`);
}

function showLine(line: number, column: number): void {
  studio.set({ side: "text" });
  void import("../../text/editor").then((module) => module.showPlace(line, column));
}

const ICONS = { error: "warning", warning: "warning", note: "help" } as const;

export function ProblemsPanel({ problems }: { problems: readonly Problem[] }) {
  const empty = useStudio((now) => now.model.bodies.length === 0);
  if (problems.length === 0) {
    return (
      <p className="quiet teach all-well">
        <Icon name="check" size={18} /> {empty ? "Nothing is drawn yet." : "No problems: the mechanism closes, moves and runs."}
      </p>
    );
  }
  return (
    <ul className="problems">
      {problems.map((one, i) => (
        <li key={i} className={one.severity}>
          <Icon name={ICONS[one.severity]} size={18} />
          <div>
            <p className="problem-title">
              <span className="visually-hidden">{one.severity}: </span>
              {one.title}
            </p>
            {one.hint && <p className="problem-hint">{one.hint}</p>}
            {one.fixes.length > 0 && (
              <p className="problem-fixes">
                {one.fixes.map((fix) => (
                  <button key={fix.label} className="chip" onClick={fix.run}>
                    {fix.label}
                  </button>
                ))}
              </p>
            )}
          </div>
        </li>
      ))}
    </ul>
  );
}
