// Play, pause, step, scrub, slow motion. The scale follows the clock without involving React.
import { useEffect, useRef } from "react";
import { runCommand } from "../commands";
import { shortNumber } from "../model/units";
import { setGhost } from "../play/kernel-session";
import { player } from "../play/player";
import { studio, useStudio } from "../state";
import { Icon } from "./icons";

const SPEEDS = [1 / 100, 1 / 20, 1 / 10, 1 / 4, 1 / 2, 1, 2, 4];

const speedName = (speed: number) => (speed >= 1 ? `${shortNumber(speed)}×` : `1/${shortNumber(1 / speed)}×`);

export function Transport() {
  const playing = useStudio((now) => now.playing);
  const mode = useStudio((now) => now.mode);
  const speed = useStudio((now) => now.speed);
  const loop = useStudio((now) => now.loop);
  const ghost = useStudio((now) => now.ghost.on);
  const show = useStudio((now) => now.show);
  const ready = useStudio((now) => now.model.bodies.length > 0);
  return (
    <section className="transport" aria-label="Play">
      <button className="play" aria-label={playing ? "Pause" : "Play"} data-tip="Play or pause  Space" disabled={!ready} onClick={() => player.toggle()}>
        <Icon name={playing ? "pause" : "play"} size={22} />
      </button>
      <button className="icon-button" aria-label="Stop" data-tip="Back to the start  Esc" disabled={mode === "edit"} onClick={() => player.stop()}>
        <Icon name="stop" />
      </button>
      <button className="icon-button" aria-label="One frame back" data-tip="One frame back  ," disabled={!ready} onClick={() => player.step(-1)}>
        <Icon name="stepBack" />
      </button>
      <button className="icon-button" aria-label="One frame forward" data-tip="One frame forward  ." disabled={!ready} onClick={() => player.step(1)}>
        <Icon name="stepOn" />
      </button>
      <Scale />
      <label className="speed">
        <span className="visually-hidden">Speed</span>
        <select value={SPEEDS.includes(speed) ? speed : ""} aria-label="Speed" onChange={(event) => studio.set({ speed: Number(event.target.value) })}>
          {!SPEEDS.includes(speed) && <option value="">{speedName(speed)}</option>}
          {SPEEDS.map((one) => (
            <option key={one} value={one}>
              {speedName(one)}
            </option>
          ))}
        </select>
      </label>
      <Toggle name="loop" label="Loop" on={loop} onClick={() => studio.set({ loop: !loop })} />
      <span className="divider" />
      <Toggle name="force" label="Joint-force arrows  ⇧F" on={show.forces} onClick={() => runCommand("show-forces")} />
      <Toggle name="labels" label="Names  ⇧N" on={show.labels} onClick={() => runCommand("show-labels")} />
      <Toggle name="ghost" label="Overlay ideal joints  H" on={ghost} onClick={() => setGhost(!ghost)} />
      <Toggle name="grid" label="Grid  ⇧G" on={show.grid} onClick={() => runCommand("show-grid")} />
      <button className="icon-button" aria-label="Fit" data-tip="Fit to the window  0" onClick={() => runCommand("fit")}>
        <Icon name="fit" />
      </button>
    </section>
  );
}

function Toggle({ name, label, on, onClick }: { name: string; label: string; on: boolean; onClick: () => void }) {
  return (
    <button className={on ? "icon-button on" : "icon-button"} aria-pressed={on} aria-label={label.replace(/ {2}.*$/, "")} data-tip={label} onClick={onClick}>
      <Icon name={name} />
    </button>
  );
}

function Scale() {
  const range = useRef<HTMLInputElement>(null);
  const clock = useRef<HTMLOutputElement>(null);
  const mode = useStudio((now) => now.mode);
  const status = useStudio((now) => now.run.status);
  const fraction = useStudio((now) => now.run.progress?.fraction ?? 0);
  useEffect(
    () =>
      player.onFrame(() => {
        if (!range.current || !clock.current) return;
        const begin = player.begin;
        const span = player.duration - begin;
        const t = studio.get().mode === "edit" ? 0 : player.t;
        const part = span > 0 ? (t - begin) / span : 0;
        range.current.value = String(Math.round(part * 1000));
        range.current.style.setProperty("--part", `${part * 100}%`);
        range.current.setAttribute("aria-valuetext", `${t.toFixed(3)} seconds`);
        clock.current.textContent = `${t.toFixed(player.digits)} s`;
      }),
    [],
  );
  const scrub = (value: string) => {
    studio.set({ playing: false });
    player.seek(player.begin + (Number(value) / 1000) * (player.duration - player.begin));
  };
  return (
    <div className="scale">
      <input ref={range} type="range" min={0} max={1000} defaultValue={0} aria-label="Time" onInput={(event) => scrub(event.currentTarget.value)} />
      {status === "running" && fraction > 0 && <span className="progress" style={{ width: `${fraction * 100}%` }} />}
      <output ref={clock} className="clock">
        0.000 s
      </output>
      <span className={`mode-badge ${mode}`}>{mode === "live" ? "live" : mode === "replay" ? "run" : status === "running" ? "computing" : "start"}</span>
    </div>
  );
}
