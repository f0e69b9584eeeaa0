// The panel below the drawing: the results of the run.
import { Suspense, lazy } from "react";
import { type DockTab, studio, useStudio } from "../state";
import { EnergyPanel } from "./results/energy";
import { Fence } from "./fence";
import { ForcesPanel } from "./results/forces";
import { ProblemsPanel, useProblems } from "./results/problems";
import { TabList } from "./tabs";
import { RunLine } from "./results/run-line";

const PlotsPanel = lazy(() => import("./results/plots").then((module) => ({ default: module.PlotsPanel })));

export function Dock() {
  const tab = useStudio((now) => now.dock);
  const problems = useProblems();
  const errors = problems.filter((one) => one.severity === "error").length;
  const tabs = [
    { id: "plots" as const, label: "Plots" },
    { id: "forces" as const, label: "Peak forces" },
    { id: "energy" as const, label: "Energy" },
    { id: "problems" as const, label: "Problems", badge: problems.length > 0 ? String(problems.length) : undefined, alarming: errors > 0 },
  ];
  const choose = (dock: DockTab) => studio.set({ dock });
  return (
    <section className="dock" aria-label="Results">
      <TabList label="Results" tabs={tabs} active={tab} panel="dock-panel" onChoose={choose} onClose={() => studio.set({ dock: null })}>
        <RunLine />
      </TabList>
      {tab && (
        <div id="dock-panel" className="dock-body" role="tabpanel" tabIndex={0} aria-label={tabs.find((one) => one.id === tab)?.label}>
          <h2 className="visually-hidden">{tabs.find((one) => one.id === tab)?.label}</h2>
          <Fence of="panel" key={tab}>
            {tab === "plots" && (
              <Suspense fallback={<p className="quiet">The plots are loading…</p>}>
                <PlotsPanel />
              </Suspense>
            )}
            {tab === "forces" && <ForcesPanel />}
            {tab === "energy" && <EnergyPanel />}
            {tab === "problems" && <ProblemsPanel problems={problems} />}
          </Fence>
        </div>
      )}
    </section>
  );
}
