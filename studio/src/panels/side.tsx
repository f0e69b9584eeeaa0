// The panel beside the drawing: properties of the selection, the model's settings, or its text.
import { Suspense, lazy } from "react";
import { type SideTab, studio, useStudio } from "../state";
import { Fence } from "./fence";
import { ModelPanel } from "./properties/model-panel";
import { Properties } from "./properties/properties";
import { TabList } from "./tabs";

const TextEditor = lazy(() => import("../text/editor").then((module) => ({ default: module.TextEditor })));

const TABS: { id: SideTab; label: string }[] = [
  { id: "properties", label: "Properties" },
  { id: "model", label: "Model" },
  { id: "text", label: "Text" },
];

export function Side() {
  const tab = useStudio((now) => now.side);
  return (
    <aside className="side" aria-label="Side panel">
      <TabList label="Side panel" tabs={TABS} active={tab} panel="side-panel" onChoose={(side) => studio.set({ side })} onClose={() => studio.set({ side: null })} />
      {tab && (
        <div id="side-panel" className="side-body" role="tabpanel" tabIndex={0} aria-label={TABS.find((one) => one.id === tab)?.label}>
          <h2 className="visually-hidden">{TABS.find((one) => one.id === tab)?.label}</h2>
          <Fence of="panel" key={tab}>
            {tab === "properties" && <Properties />}
            {tab === "model" && <ModelPanel />}
            {tab === "text" && (
              <Suspense fallback={<p className="quiet">The editor is loading…</p>}>
                <TextEditor />
              </Suspense>
            )}
          </Fence>
        </div>
      )}
    </aside>
  );
}
