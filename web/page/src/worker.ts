// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT

// Reads and segments scans, so that the page stays responsive.
import { Session } from "./flagstone";
import { contentOf } from "./map_files";
import type { Kind, Requests } from "./messages";

let session: Promise<Session> | undefined;

async function answer(kind: Kind, request: Requests[Kind]["request"]): Promise<unknown> {
  const running = await (session ??= Session.start());
  switch (kind) {
    case "open": {
      const { file, columns } = request as Requests["open"]["request"];
      return running.open(file.name, await contentOf(file), columns);
    }
    case "map": {
      const { name, files } = request as Requests["map"]["request"];
      return running.map(name, files);
    }
    case "segment":
      return running.segment((request as Requests["segment"]["request"]).options);
    case "compare":
      return running.compare((request as Requests["compare"]["request"]).options);
    case "doctor":
      return running.doctor((request as Requests["doctor"]["request"]).options);
    case "save": {
      const { name, map } = request as Requests["save"]["request"];
      return running.save(name, map);
    }
  }
}

/** The memory of the arrays in a reply, which is transferred and not copied. */
function buffers(value: unknown): Transferable[] {
  if (ArrayBuffer.isView(value)) return [value.buffer as ArrayBuffer];
  if (Array.isArray(value)) return typeof value[0] === "object" ? value.flatMap(buffers) : [];
  if (typeof value === "object" && value !== null) return Object.values(value).flatMap(buffers);
  return [];
}

onmessage = async ({ data: { id, kind, request } }: MessageEvent) => {
  try {
    const reply = await answer(kind, request);
    postMessage({ id, reply }, { transfer: buffers(reply) });
  } catch (error) {
    // After a trap the memory of the module is not reliable.
    if (error instanceof WebAssembly.RuntimeError) session = undefined;
    postMessage({ id, error: error instanceof Error ? error.message : String(error) });
  }
};
