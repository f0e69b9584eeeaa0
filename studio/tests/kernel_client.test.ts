// The page's client with a worker that is played by the test: answers, faults, a worker that dies.
import { describe, expect, it, vi } from "vitest";
import { KernelFault, startKernel } from "../src/kernel/kernel";
import type { FromWorker, ToWorker } from "../src/kernel/messages";
import { loadKernel, valueOf } from "../src/kernel/module";
import { unpacked } from "../src/kernel/packed";

class PlayedWorker {
  static made: PlayedWorker[] = [];
  onmessage: ((event: { data: FromWorker }) => void) | null = null;
  onerror: ((event: { message: string }) => void) | null = null;
  sent: ToWorker[] = [];
  terminated = false;
  constructor() {
    PlayedWorker.made.push(this);
  }
  postMessage(message: ToWorker) {
    this.sent.push(message);
  }
  terminate() {
    this.terminated = true;
  }
  answer(message: Partial<FromWorker>) {
    this.onmessage?.({ data: { id: this.sent.at(-1)?.id ?? 0, ...message } });
  }
}

function start(files?: () => Record<string, string>) {
  PlayedWorker.made = [];
  return startKernel({ makeWorker: () => new PlayedWorker() as unknown as Worker, kernelUrl: "kernel/pintle.wasm", files });
}

describe("the kernel's client", () => {
  it("answers a call and rejects with a fault", async () => {
    const kernel = start();
    const reading = kernel.read("format = 1");
    PlayedWorker.made[0]?.answer({ value: { ok: true, complaints: [] } });
    expect(await reading).toEqual({ ok: true, complaints: [] });
    const checking = kernel.check("x");
    PlayedWorker.made[1]?.answer({ fault: { message: "no", hint: "try" } });
    await expect(checking).rejects.toMatchObject({ message: "no", hint: "try" });
  });

  it("sends the files that the text names: those of the open model, unless the call has its own", () => {
    const kernel = start(() => ({ "mine.csv": "open", "other.csv": "unused" }));
    void kernel.check('file = "mine.csv"');
    void kernel.run('file = "mine.csv"', { files: { "mine.csv": "own" } });
    const sent = PlayedWorker.made.map((worker) => (worker.sent[0]!.args as { files: unknown }).files);
    expect(sent).toEqual([{ "mine.csv": "open" }, { "mine.csv": "own" }]);
  });

  it("rejects what was pending when a worker dies, and starts another", async () => {
    const kernel = start();
    const first = kernel.read("a"), second = kernel.read("b");
    PlayedWorker.made[0]?.onerror?.({ message: "out of memory" });
    await expect(first).rejects.toBeInstanceOf(KernelFault);
    await expect(second).rejects.toThrow(/out of memory/);
    const third = kernel.read("c");
    expect(PlayedWorker.made.length).toBe(2);
    PlayedWorker.made[1]?.answer({ value: { ok: false, complaints: [] } });
    expect((await third).ok).toBe(false);
  });

  it("tells progress, takes back the sign to go on, and gives up on a worker that does not hear", async () => {
    vi.useFakeTimers();
    const kernel = start();
    const revoked = vi.spyOn(URL, "revokeObjectURL");
    const fractions: number[] = [];
    const run = kernel.run("x", { onProgress: (progress) => fractions.push(progress.fraction) });
    const worker = PlayedWorker.made[0];
    worker?.answer({ progress: { fraction: 0.5, t: 1, duration: 2, pass: 1, wall_seconds: 1, seconds_left: 1 } });
    expect(fractions).toEqual([0.5]);
    run.cancel();
    expect(revoked).toHaveBeenCalledWith(worker?.sent[0]?.goOn);
    const rejected = expect(run.result).rejects.toThrow(/cancelled/);
    await vi.advanceTimersByTimeAsync(10_000);
    await rejected;
    expect(worker?.terminated).toBe(true);
    vi.useRealTimers();
  });

  it("leaves a run alone while one behind it is cancelled, and counts the grace from its turn", async () => {
    vi.useFakeTimers();
    const kernel = start();
    const first = kernel.run("a"), second = kernel.run("b");
    const worker = PlayedWorker.made[0]!;
    second.cancel();
    await vi.advanceTimersByTimeAsync(60_000);
    expect(worker.terminated).toBe(false);
    worker.onmessage?.({ data: { id: worker.sent[0]!.id, value: { outcome: "completed" } } });
    expect((await first.result).outcome).toBe("completed");
    const ended = expect(second.result).rejects.toMatchObject({ fault: { kind: "ended" } });
    await vi.advanceTimersByTimeAsync(2000);
    expect(worker.terminated).toBe(false);
    await vi.advanceTimersByTimeAsync(2000);
    await ended;
    expect(worker.terminated).toBe(true);
    vi.useRealTimers();
  });

  it("checks and reports beside a run, not behind it", async () => {
    const kernel = start();
    void kernel.run("x");
    const checking = kernel.check("x"), reporting = kernel.report("x");
    expect(PlayedWorker.made.map((worker) => worker.sent.map((one) => one.call))).toEqual([["run"], ["check"], ["report"]]);
    PlayedWorker.made[1]!.answer({ value: { passed: true } });
    PlayedWorker.made[2]!.answer({ value: { html: "page" } });
    expect([(await checking).passed, await reporting]).toEqual([true, "page"]);
  });

  it("tells a kernel that is missing from one that broke down", async () => {
    const kernel = start();
    const lost = expect(kernel.read("a")).rejects.toMatchObject({ fault: { kind: "missing" } });
    PlayedWorker.made[0]!.onerror?.({ message: "no such file" });
    await lost;
    const read = kernel.read("b");
    PlayedWorker.made[1]!.answer({ value: { ok: true, complaints: [] } });
    await read;
    const broken = kernel.read("c").catch((error: KernelFault) => error.fault);
    PlayedWorker.made[1]!.onerror?.({ message: "out of memory" });
    expect(((await broken) as { kind?: string }).kind).toBeUndefined();
    vi.stubGlobal("fetch", async () => new Response("", { status: 404 }));
    await expect(loadKernel("kernel/pintle.wasm")).rejects.toMatchObject({ fault: { kind: "missing" } });
    vi.unstubAllGlobals();
  });
});

describe("answers", () => {
  it("have their arrays in place", () => {
    const { value } = valueOf('{"value": {"a": {"f64": 0}, "list": [{"f64": 1}], "n": null}}', [Float64Array.of(1), Float64Array.of(2, 3)]);
    expect(value).toEqual({ a: Float64Array.of(1), list: [Float64Array.of(2, 3)], n: null });
  });

  it("come in one piece", () => {
    const text = new TextEncoder().encode('{"value": {"f64": 1}}');
    const bytes = new ArrayBuffer(16 + 24 + text.length);
    new Uint32Array(bytes, 0, 4).set([text.length, 2, 1, 2]);
    new Float64Array(bytes, 16, 3).set([1.5, 2.5, -3]);
    new Uint8Array(bytes, 40).set(text);
    expect(unpacked(bytes).value).toEqual(Float64Array.of(2.5, -3));
  });
});
