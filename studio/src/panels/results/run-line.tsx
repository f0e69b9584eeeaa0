// One line on the state of the run: computing, finished after some time, stopped.
import { cancelRun } from "../../play/kernel-session";
import { quantity } from "../../model/units";
import { runCommand } from "../../commands";
import { useStudio } from "../../state";
import { Icon } from "../icons";

export function RunLine() {
  const run = useStudio((now) => now.run);
  const kept = useStudio((now) => now.kept);
  const kernelState = useStudio((now) => now.kernelState);
  const left = run.progress?.seconds_left;
  return (
    <div className="run-line">
      {kernelState === "missing" && <span className="state bad">no kernel</span>}
      {run.status === "running" && (
        <>
          <span className="state busy">
            computing {run.progress ? `${Math.round(run.progress.fraction * 100)} %` : ""}
            {left && left > 1 ? `, ${quantity(left, "s", 2)} left` : ""}
          </span>
          {run.progress && (
            <button className="chip" onClick={cancelRun}>
              Stop
            </button>
          )}
        </>
      )}
      {run.status === "done" && run.answer && (
        <span className="state good" data-tip={`Method ${run.answer.method}, tolerance ${run.answer.tolerance}`}>
          {quantity(run.answer.t_end, "s", 3)} in {quantity(run.answer.wall_seconds, "s", 2)}
        </span>
      )}
      {run.status === "failed" && <span className="state bad">{run.fault ? "not run" : "stopped early"}</span>}
      <button className={kept ? "chip on" : "chip"} aria-pressed={kept !== null} data-tip="Pin this run for comparison (dashed)  B" disabled={!run.answer} onClick={() => runCommand("keep")}>
        <Icon name="compare" size={14} /> {kept ? "Unpin run" : "Pin run"}
      </button>
    </div>
  );
}
