// The server of `pintle studio`, if it serves the page: the native kernel for long runs, and the models of the folder in which it
// was started in. docs/reference/studio-server.md
import { KernelFault } from "./fault";
import type { NamedFiles } from "./named-files";
import { unpacked } from "./packed";
import type { RunAnswer, RunProgress } from "./protocol";

export interface FolderModel {
  /** Relative to the folder: "press/toggle.toml". */
  path: string;
  size: number;
}

export interface OpenedModel {
  path: string;
  text: string;
  /** Of the file's content; sent back when the file is saved. */
  hash: string;
  /** The texts of the files that the model names, if they are in the folder. */
  files: Record<string, string>;
}

/** The file was changed by something else since it was opened; `text` is null if it was deleted. */
export interface Conflict {
  text: string | null;
  hash: string | null;
}

export interface NativeServer {
  version: string;
  /** The folder's name. */
  folder: string;
  /** The model that the program was started with. */
  model: string | null;
  list(): Promise<FolderModel[]>;
  open(path: string): Promise<OpenedModel>;
  /** `expected` is the hash of the content to be replaced, null for a new file. */
  save(path: string, text: string, expected: string | null): Promise<{ hash: string } | { conflict: Conflict }>;
  run(text: string, set: Record<string, string>, files: NamedFiles, onProgress?: (progress: RunProgress) => void): { result: Promise<RunAnswer>; cancel(): void };
}

const kPollMilliseconds = 200;
const kTokenKey = "pintle.token";

export const sessionTokenIn = (hash: string): string | undefined => /(?:^#|[#&])token=([0-9a-f]+)/.exec(hash)?.[1];

/** The token of this session: in the address when the page is opened, then stored for reloads of this tab. */
export function sessionToken(location: Location = window.location): string | null {
  const found = sessionTokenIn(location.hash);
  try {
    if (found) sessionStorage.setItem(kTokenKey, found);
    return found ?? sessionStorage.getItem(kTokenKey);
  } catch {
    return found ?? null;
  }
}

class Questions {
  constructor(
    private readonly base: string,
    private readonly token: string,
  ) {}

  async ask(path: string, method = "GET", body?: unknown): Promise<Response> {
    try {
      const headers: Record<string, string> = { "X-Pintle-Token": this.token };
      if (body !== undefined) headers["Content-Type"] = "application/json";
      return await fetch(this.base + path, { method, headers, body: body === undefined ? undefined : JSON.stringify(body), cache: "no-store" });
    } catch {
      throw new KernelFault({ message: "pintle studio does not answer.", hint: "Is the program still running? Your work is safe in this page." });
    }
  }

  async json<T>(path: string, method = "GET", body?: unknown): Promise<T> {
    return (await this.good(await this.ask(path, method, body))).json() as Promise<T>;
  }

  async good(response: Response): Promise<Response> {
    if (response.ok) return response;
    const told = (await response.json().catch(() => null)) as { fault?: { message: string; hint: string } } | null;
    throw new KernelFault(told?.fault ?? { message: `pintle studio refused the request (${response.status}).`, hint: "Open the address it printed." });
  }
}

/** The server, or null if another server serves the page. */
export async function findNativeServer(base = new URL("api/", document.baseURI).href, token = sessionToken()): Promise<NativeServer | null> {
  if (!token) return null;
  const questions = new Questions(base, token);
  const about = await questions.json<{ version: string; folder: string; model: string | null }>("about").catch(() => null);
  return about && { ...about, ...filesOf(questions), run: (text, set, files, onProgress) => runOn(questions, { text, set, files }, onProgress) };
}

function filesOf(questions: Questions): Pick<NativeServer, "list" | "open" | "save"> {
  return {
    list: async () => (await questions.json<{ models: FolderModel[] }>("models")).models,
    open: (path) => questions.json(`model?path=${encodeURIComponent(path)}`),
    save: async (path, text, expected) => {
      const response = await questions.ask("model", "PUT", { path, text, expected });
      if (response.status === 409) return { conflict: (await response.json()) as Conflict };
      return (await questions.good(response)).json() as Promise<{ hash: string }>;
    },
  };
}

function runOn(questions: Questions, asked: { text: string; set: Record<string, string>; files: NamedFiles }, onProgress?: (progress: RunProgress) => void) {
  let cancelled = false;
  let path: string | undefined;
  const stop = () => path && questions.ask(path, "DELETE").catch(() => undefined);
  const result = (async () => {
    path = `runs/${(await questions.json<{ id: number }>("runs", "POST", asked)).id}`;
    if (cancelled) await stop();
    for (;;) {
      const now = await questions.json<{ state: "running" | "done"; progress?: RunProgress | null }>(path);
      if (now.state === "done") break;
      if (now.progress) onProgress?.(now.progress);
      await new Promise((resolve) => setTimeout(resolve, kPollMilliseconds));
    }
    const answer = await questions.good(await questions.ask(`${path}/result`));
    try {
      return unpacked(await answer.arrayBuffer()).value as RunAnswer;
    } catch (error) {
      throw new KernelFault((error as { fault: KernelFault["fault"] }).fault);
    } finally {
      void stop();
    }
  })();
  return {
    result,
    cancel: () => {
      cancelled = true;
      void stop();
    },
  };
}
