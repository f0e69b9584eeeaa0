// A small server of the built pages on the loopback, for the browser tests. Like `pintle studio` it sends what is compressed.
import { existsSync, readFileSync, statSync } from "node:fs";
import { createServer } from "node:http";
import { extname, join, normalize, resolve, sep } from "node:path";

const TYPES = { ".html": "text/html", ".js": "text/javascript", ".css": "text/css", ".wasm": "application/wasm", ".svg": "image/svg+xml", ".json": "application/json" };

/** Resolves to {url, sent, close}; `sent` has the bytes sent of each path. */
export function serve(folder) {
  const root = resolve(folder);
  const sent = new Map();
  const server = createServer((request, response) => {
    const path = decodeURIComponent(new URL(request.url, "http://localhost").pathname);
    const file = normalize(join(root, path === "/" ? "index.html" : path));
    if (!file.startsWith(root + sep) || !existsSync(file) || !statSync(file).isFile()) {
      response.writeHead(404).end();
      return;
    }
    const compressed = existsSync(`${file}.br`);
    const body = readFileSync(compressed ? `${file}.br` : file);
    response.writeHead(200, { "content-type": TYPES[extname(file)] ?? "application/octet-stream", ...(compressed && { "content-encoding": "br" }) });
    sent.set(path, body.length);
    response.end(body);
  });
  return new Promise((done) => {
    server.listen(0, "127.0.0.1", () => done({ url: `http://127.0.0.1:${server.address().port}/`, sent, close: () => server.close() }));
  });
}
