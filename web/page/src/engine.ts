// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT

import type { Kind, Requests } from "./messages";

interface Waiting {
  resolve: (reply: never) => void;
  reject: (error: Error) => void;
}

/** Sends requests to its own worker. */
export class Engine {
  readonly #worker = new Worker(new URL("./worker.ts", import.meta.url), { type: "module" });
  readonly #waiting = new Map<number, Waiting>();
  #next = 0;

  constructor() {
    this.#worker.onmessage = ({ data: { id, reply, error } }) => {
      const waiting = this.#waiting.get(id);
      this.#waiting.delete(id);
      if (error !== undefined) waiting?.reject(new Error(error));
      else waiting?.resolve(reply as never);
    };
    this.#worker.onerror = (event) => {
      event.preventDefault();
      const error = new Error("the page cannot start its worker (expected a browser with WebAssembly; reload the page)");
      for (const { reject } of this.#waiting.values()) reject(error);
      this.#waiting.clear();
    };
  }

  ask<K extends Kind>(kind: K, request: Requests[K]["request"]): Promise<Requests[K]["reply"]> {
    const id = this.#next++;
    return new Promise((resolve, reject) => {
      this.#waiting.set(id, { resolve, reject });
      this.#worker.postMessage({ id, kind, request });
    });
  }
}
