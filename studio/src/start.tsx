// Starts the page: restores the previous state, starts kernel and clock, and draws.
import { createRoot } from "react-dom/client";
import { editText, openText } from "./actions";
import { App } from "./app";
import { theView } from "./drawing/canvas";
import { restore, startAutosave } from "./files/autosave";
import { startFolder } from "./files/folder";
import { followAddress, openFromAddress } from "./files/share";
import { Fence } from "./panels/fence";
import { startKernelSession } from "./play/kernel-session";
import { studio } from "./state";
import { player } from "./play/player";
import "./styles/base.css";
import "./styles/layout.css";
import "./styles/panels.css";
import "./styles/scene.css";

// For the browser tests and for use in the console.
Object.assign(window, { pintleStudio: studio, pintleView: theView, pintleEdit: editText, pintleOpen: openText });
restore();
startAutosave();
const root = document.getElementById("root");
if (root) {
  createRoot(root).render(
    <Fence of="page">
      <App />
    </Fence>,
  );
}
player.start();
void openFromAddress().then((opened) => {
  startKernelSession();
  void startFolder(!opened);
});
window.addEventListener("hashchange", followAddress);
