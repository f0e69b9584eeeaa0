// The collection: the text of every mechanism of the repository, and the files that these name.
import { type NamedFiles, filesNamedIn } from "../kernel/named-files";

const files = import.meta.glob("../../../mechanisms/*.toml", { query: "?raw", import: "default", eager: true }) as Record<string, string>;
const TABLES: NamedFiles = Object.fromEntries(Object.entries(import.meta.glob("../../../mechanisms/*.csv", { query: "?raw", import: "default", eager: true }) as Record<string, string>).map(([path, text]) => [baseName(path), text]));

function baseName(path: string): string {
  return path.replace(/^.*\//, "");
}

export interface Template {
  file: string;
  name: string;
  /** Its first sentence. */
  about: string;
  text: string;
  /** The files that it names. */
  files: NamedFiles;
}

const ORDER = [
  "four_bar", "slider_crank", "engine", "pendulum", "quick_return", "cam_follower", "gear_train", "belt_drive", "atwood", "bollard", "crane_bushing", "six_bar", "toggle_press", "scissor_lift", "trammel", "two_loop_engine",
  "inverted_slider_crank", "robot_arm", "andrews", "five_bar_parallelogram", "rope_pendulum", "weld_beam", "loose_ball_bearing", "lubricated_crank", "oil_film_rotor",
  "slider_crank_clearance", "worn_linkage", "four_bar_clearance", "scotch_yoke_play", "loose_piston", "hopper", "strut_on_tyre", "wheel_over_bump", "jaw_coupling", "bar_clamp", "stick_slip", "conveyor_belt",
];

export const TEMPLATES: readonly Template[] = Object.entries(files)
  .map(([path, text]) => {
    const file = baseName(path);
    const head = /^(?:#.*\n)+/.exec(text)?.[0].replace(/^#\s?/gm, "").replace(/\n/g, " ") ?? "";
    return {
      file,
      name: /^name = "(.*)"$/m.exec(text)?.[1] ?? file,
      about: (/^.*?\.(?=\s)/.exec(head)?.[0] ?? head).trim(),
      text,
      files: filesNamedIn(text, TABLES),
    };
  })
  .sort((a, b) => rank(a.file) - rank(b.file) || a.file.localeCompare(b.file, "en", { numeric: true }));

function rank(file: string): number {
  const at = ORDER.indexOf(file.replace(/\.toml$/, ""));
  return at < 0 ? ORDER.length : at;
}
