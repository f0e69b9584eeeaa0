// The kernel in its worker: receives calls and answers them. It runs outside the page's thread, so that a long call never delays a frame.
import { loadKernel, type KernelModule } from "./module";
import type { FromWorker, ToWorker } from "./messages";
import type { Fault } from "./protocol";

let kernel: Promise<KernelModule> | undefined;

function send(message: FromWorker, transfer: Transferable[] = []) {
  (self as unknown as DedicatedWorkerGlobalScope).postMessage(message, transfer);
}

/** True once the page has revoked the address that stands for "go on": the only signal that reaches a busy worker. */
function isCancelled(goOn: string | undefined): boolean {
  if (!goOn) return false;
  try {
    const request = new XMLHttpRequest();
    request.open("GET", goOn, false);
    request.send();
    return request.status !== 200;
  } catch {
    return true;
  }
}

/** The module; a new one if it crashed or could not be loaded. */
async function ready(url: string): Promise<KernelModule> {
  if (kernel && (await kernel.catch(() => undefined))?.broken !== false) kernel = undefined;
  kernel ??= loadKernel(url);
  return kernel;
}

self.onmessage = async (event: MessageEvent<ToWorker>) => {
  const { id, call, args, goOn, kernelUrl } = event.data;
  try {
    const module = await ready(kernelUrl);
    const { value, arrays } = module.call(call, args, (progress) => {
      send({ id, progress });
      return !isCancelled(goOn);
    });
    send({ id, value }, arrays.map((array) => array.buffer as ArrayBuffer));
  } catch (error) {
    send({ id, fault: faultOf(error) });
  }
};

function faultOf(error: unknown): Fault {
  if (typeof error === "object" && error !== null && "fault" in error) return (error as { fault: Fault }).fault;
  const message = error instanceof Error ? error.message : String(error);
  return { message: `The kernel failed: ${message}`, hint: "Nothing is lost. Change the model and try again." };
}
