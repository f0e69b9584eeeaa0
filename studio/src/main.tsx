// Begins the page: brings back what was there, starts kernel and clock, and draws.
import { createRoot } from "react-dom/client";
import { App } from "./app";
import { restore, startAutosave } from "./files/autosave";
import { openFromAddress } from "./files/share";
import { Fence } from "./panels/fence";
import { startDesk } from "./play/desk";
import { player } from "./play/player";
import "./styles/base.css";
import "./styles/layout.css";
import "./styles/panels.css";
import "./styles/scene.css";

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
void openFromAddress().then(startDesk);
window.addEventListener("hashchange", () => void openFromAddress());
