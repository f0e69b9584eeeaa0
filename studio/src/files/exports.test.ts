import "../../tests/page";
import { beforeEach, expect, it, vi } from "vitest";
import type { RunAnswer } from "../kernel/protocol";
import { NO_RUN, type RunState, isOutdated, studio } from "../state";

vi.mock("../play/kernel-session", () => ({ kernel: {} }));
vi.mock("./disk", () => ({ download: vi.fn() }));
vi.mock("../styles/scene.css?inline", () => ({ default: "" }));
const { exportAs } = await import("./exports");

const answer = (outcome: RunAnswer["outcome"]) => ({ outcome, columns: [{ name: "time", unit: "s" }], values: [Float64Array.of(0, 1)] }) as unknown as RunAnswer;
const run = (status: RunState["status"], outcome: RunAnswer["outcome"] = "completed"): RunState => ({ ...NO_RUN, status, answer: answer(outcome) });

beforeEach(() => studio.set({ toasts: [] }));

it.each([
  [run("done"), null],
  [run("failed", "failed"), null],
  [run("running"), "the new run is not computed yet"],
  [run("none"), "the model as it is now has no run"],
  [run("failed"), "the model as it is now has no run"],
] as const)("a CSV of an outdated run says so, and whether a new one is coming", async (state, words) => {
  studio.set({ run: state });
  await exportAs("csv");
  expect(isOutdated(state)).toBe(words !== null);
  expect(studio.get().toasts.map((toast) => toast.text)).toEqual(words === null ? [] : [expect.stringContaining(words)]);
});

it("no run is not an outdated one", () => {
  expect(isOutdated(NO_RUN)).toBe(false);
});
