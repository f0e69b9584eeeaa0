// The folder of `pintle studio`, where the page comes from that program: models are opened from it and saved into it.
import { asFault, openText, say } from "../actions";
import type { NativeServer } from "../kernel/native";
import { kernel } from "../play/desk";
import { studio } from "../state";

let server: NativeServer | null = null;
/** The file that is open, and the hash of what it held when it was read or written last. */
let open: { path: string; hash: string | null } | null = null;

export const inFolder = (): boolean => server !== null;

/** Looks for the program behind the page, and opens the model that it was started with. */
export async function startFolder(): Promise<void> {
  server = await kernel.native().catch(() => null);
  if (!server) return;
  studio.set({ folder: { name: server.folder, models: [] } });
  if (server.model) await openFromFolder(server.model);
}

export async function showFolder(): Promise<void> {
  if (!server) return;
  try {
    studio.set({ folder: { name: server.folder, models: await server.list() }, dialog: "folder" });
  } catch (error) {
    say(asFault(error).message);
  }
}

export async function openFromFolder(path: string): Promise<void> {
  if (!server) return;
  try {
    const opened = await server.open(path);
    openText(opened.text, opened.path);
    open = { path: opened.path, hash: opened.hash };
    studio.set({ dialog: null });
  } catch (error) {
    say(asFault(error).message);
  }
}

/** Writes the text into the folder. A file that another program has changed meanwhile is not overwritten unasked. */
export async function saveToFolder(): Promise<void> {
  const { fileName, history } = studio.get();
  if (!server) return;
  const expected = open?.path === fileName ? open.hash : null;
  try {
    const saved = await server.save(fileName, history.text, expected);
    if ("hash" in saved) {
      open = { path: fileName, hash: saved.hash };
      studio.set({ savedText: history.text });
      return say(`Saved ${fileName} in ${server.folder}.`);
    }
    const { conflict } = saved;
    say(`${fileName} ${expected === null ? "is there already" : "was changed by another program"}.`, {
      label: "Write over it",
      run: () => {
        open = { path: fileName, hash: conflict.hash };
        void saveToFolder();
      },
    });
  } catch (error) {
    say(asFault(error).message);
  }
}
