// Two simulated kernels: which one computes a long run, and what happens if the server is lost.
import { describe, expect, it } from "vitest";
import type { RunOptions } from "../kernel/kernel";
import type { RunAnswer } from "../kernel/protocol";
import { runWhereFastest } from "./long-run";
import { PlayedRun } from "./played-run-for-tests";

const answer = (method: string) => ({ outcome: "completed", method }) as RunAnswer;
const turn = () => new Promise((resolve) => setTimeout(resolve, 0));

function begin() {
  const runs: PlayedRun[] = [];
  const seen: number[] = [];
  const kernel = { run: (_: string, options: RunOptions = {}) => runs[runs.push(new PlayedRun(options)) - 1]! };
  const run = runWhereFastest(kernel, "text", () => true, (progress) => seen.push(progress.fraction));
  return { run, runs, seen };
}

describe("a long run", () => {
  it("moves to the native kernel once that one moves", async () => {
    const { run, runs, seen } = begin();
    runs[0]!.tell(0.1, 60);
    expect(runs[1]?.options.where).toBe("native");
    expect(runs[0]!.cancelled).toBe(false);
    runs[0]!.tell(0.2, 50);
    runs[1]!.tell(0.3, 2);
    expect(runs[0]!.cancelled).toBe(true);
    runs[0]!.resolve(answer("interrupted here"));
    await turn();
    runs[1]!.resolve(answer("native"));
    expect((await run.result).method).toBe("native");
    expect(seen).toEqual([0.1, 0.2, 0.3]);
  });

  it.each(["429", "401", "no answer"])("stays where it is when the server says %s", async (why) => {
    const { run, runs, seen } = begin();
    runs[0]!.tell(0.1, 60);
    runs[1]!.reject(new Error(why));
    await turn();
    expect(runs[0]!.cancelled).toBe(false);
    runs[0]!.tell(0.2, 50);
    expect(runs.length).toBe(2);
    runs[0]!.resolve(answer("here"));
    expect((await run.result).method).toBe("here");
    expect(seen).toEqual([0.1, 0.2]);
  });

  it("begins again in the browser when the server is lost on the way", async () => {
    const { run, runs } = begin();
    runs[0]!.tell(0.1, 60);
    runs[1]!.tell(0.2, 30);
    runs[1]!.reject(new Error("gone"));
    await turn();
    runs[2]!.resolve(answer("here"));
    expect(runs[2]!.options.where).toBeUndefined();
    expect((await run.result).method).toBe("here");
  });

  it("ends in both places when it is cancelled", async () => {
    const { run, runs } = begin();
    runs[0]!.tell(0.1, 60);
    run.cancel();
    expect(runs.map((one) => one.cancelled)).toEqual([true, true]);
    runs[0]!.resolve(answer("as far as it came"));
    expect((await run.result).method).toBe("as far as it came");
  });
});
