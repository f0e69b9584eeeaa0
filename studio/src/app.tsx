// The page: header, tools, drawing, panels.
import { Suspense, lazy, useEffect } from "react";
import { dismiss } from "./actions";
import { listenToKeys } from "./commands";
import { Canvas } from "./drawing/canvas";
import { listenToDrops } from "./files/disk";
import { Dock } from "./panels/dock";
import { EmptyDrawing } from "./panels/empty";
import { Fence } from "./panels/fence";
import { Header } from "./panels/header";
import { Side } from "./panels/side";
import { Tools } from "./panels/tools";
import { Transport } from "./panels/transport";
import { useStudio } from "./state";

const Gallery = lazy(() => import("./panels/gallery").then((module) => ({ default: module.Gallery })));
const Palette = lazy(() => import("./panels/palette").then((module) => ({ default: module.Palette })));
const FolderDialog = lazy(() => import("./panels/folder").then((module) => ({ default: module.FolderDialog })));
const SaveDialog = lazy(() => import("./panels/save").then((module) => ({ default: module.SaveDialog })));
const DraftsDialog = lazy(() => import("./panels/properties/drafts").then((module) => ({ default: module.DraftsDialog })));
const Help = lazy(() => import("./panels/help").then((module) => ({ default: module.Help })));

export function App() {
  const dialog = useStudio((now) => now.dialog);
  const theme = useStudio((now) => now.theme);
  const dock = useStudio((now) => now.dock);
  const side = useStudio((now) => now.side);
  const mode = useStudio((now) => now.mode);
  useEffect(() => {
    document.documentElement.dataset["theme"] = theme;
  }, [theme]);
  useEffect(() => {
    const ends = [listenToKeys(), listenToDrops()];
    return () => ends.forEach((end) => end());
  }, []);
  return (
    <div className={`app ${dock ? "" : "dock-closed"} ${side ? "" : "side-closed"} ${side === "text" ? "side-wide" : ""} mode-${mode}`}>
      <Header />
      <Tools />
      <main className="stage" aria-label="Drawing">
        <Fence of="drawing">
          <Canvas />
        </Fence>
        <EmptyDrawing />
        <Toasts />
      </main>
      <Transport />
      <Fence of="side panel">
        <Side />
      </Fence>
      <Fence of="results">
        <Dock />
      </Fence>
      <Suspense fallback={null}>
        {dialog === "gallery" && <Gallery />}
        {dialog === "palette" && <Palette />}
        {dialog === "help" && <Help />}
        {dialog === "folder" && <FolderDialog />}
        {dialog === "drafts" && <DraftsDialog />}
        {dialog === "save" && <SaveDialog />}
      </Suspense>
    </div>
  );
}

function Toasts() {
  const toasts = useStudio((now) => now.toasts);
  return (
    <div className="toasts" role="status" aria-live="polite">
      {toasts.map((toast) => (
        <div className="toast" key={toast.id}>
          <span>{toast.text}</span>
          {toast.action && (
            <button
              onClick={() => {
                toast.action?.run();
                dismiss(toast.id);
              }}
            >
              {toast.action.label}
            </button>
          )}
        </div>
      ))}
    </div>
  );
}
