// A link that contains the whole model: compressed, in the part of the address that is never sent to a server.
import { openText, say } from "../actions";
import { sessionTokenIn } from "../kernel/native";
import { EMPTY_MODEL } from "../model/operations";
import { studio } from "../state";

const MARK = "#m=";

async function through(bytes: Uint8Array, stream: CompressionStream | DecompressionStream, most = Number.POSITIVE_INFINITY): Promise<Uint8Array> {
  const reader = new Blob([bytes as BlobPart]).stream().pipeThrough(stream).getReader();
  const parts: Uint8Array[] = [];
  let size = 0;
  for (;;) {
    const { done, value } = await reader.read();
    if (done) break;
    size += value.length;
    if (size > most) throw new Error("too long");
    parts.push(value);
  }
  const whole = new Uint8Array(size);
  let at = 0;
  for (const part of parts) {
    whole.set(part, at);
    at += part.length;
  }
  return whole;
}

export async function encodeModel(text: string): Promise<string> {
  const packed = await through(new TextEncoder().encode(text), new CompressionStream("deflate-raw"));
  let binary = "";
  for (const byte of packed) binary += String.fromCharCode(byte);
  return btoa(binary).replace(/\+/g, "-").replace(/\//g, "_").replace(/=+$/, "");
}

/** Null if it is not a model packed by this program. */
export async function decodeModel(code: string): Promise<string | null> {
  try {
    const binary = atob(code.replace(/-/g, "+").replace(/_/g, "/"));
    const bytes = Uint8Array.from(binary, (char) => char.charCodeAt(0));
    return new TextDecoder("utf-8", { fatal: true }).decode(await through(bytes, new DecompressionStream("deflate-raw"), 20e6));
  } catch {
    return null;
  }
}

export async function shareLink(): Promise<void> {
  const { history } = studio.get();
  const link = `${location.href.replace(/#.*$/, "")}${MARK}${await encodeModel(history.text)}`;
  const copied = await navigator.clipboard?.writeText(link).then(
    () => true,
    () => false,
  );
  if (!copied) showInAddress(link);
  const reach = isLocal() ? "It opens only on this computer while this server runs; send others the saved file." : "Anyone who opens it sees this model.";
  say(`${copied ? "The link is copied." : "The link is in the address bar: copy it from there."} ${reach}`);
}

const isLocal = (): boolean => /^(localhost|127\.[\d.]+|\[::1\])?$/.test(location.hostname);

// Removed at the next change: otherwise a reload would replace later work by the link's model.
function showInAddress(link: string): void {
  const { history } = studio.get();
  window.history.replaceState(null, "", link);
  const end = studio.subscribe(() => {
    if (studio.get().history === history) return;
    end();
    clearAddress();
  });
}

function clearAddress(): void {
  if (location.hash.startsWith(MARK)) window.history.replaceState(null, "", location.href.replace(/#.*$/, ""));
}

/** Opens the model in the page's address, if there is one. From then on it is a draft like any other. */
export async function openFromAddress(): Promise<boolean> {
  if (!location.hash.startsWith(MARK)) return false;
  const text = await decodeModel(location.hash.slice(MARK.length));
  clearAddress();
  if (text === null) {
    say("The link's model cannot be read: the link may be truncated. Ask for the complete link.");
    return false;
  }
  const mine = studio.get().history.text;
  if (mine === text) return true;
  openText(text, "shared.toml", { savedText: "" });
  if (mine !== EMPTY_MODEL) say("This is the link's model. Undo returns to yours.");
  return true;
}

/** The address of an open page has been changed: to another link, or to the address of a restarted `pintle studio`. */
export function followAddress(): void {
  if (sessionTokenIn(location.hash)) location.reload();
  else void openFromAddress();
}
