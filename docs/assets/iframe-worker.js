/* SPDX-FileCopyrightText: 2026 flagstone contributors */
/* SPDX-License-Identifier: MIT */

/* Makes the search work in a site that is opened from the file system. The search runs in a worker, and browsers do
   not start workers from files. This Worker runs its script in a hidden frame instead. */
if (location.protocol === "file:") {
  const load = (page, address) =>
    new Promise((resolve, reject) => {
      const script = page.createElement("script");
      Object.assign(script, { src: address, onload: resolve, onerror: reject });
      page.body.append(script);
    });

  window.Worker = class extends EventTarget {
    #frame = document.createElement("iframe");
    #loaded;

    constructor(address) {
      super();
      this.#frame.hidden = true;
      document.body.append(this.#frame);
      const scope = this.#frame.contentWindow;
      scope.document.open();
      scope.document.write("<!doctype html><body></body>");
      scope.document.close();
      scope.postMessage = (data) => this.dispatchEvent(new MessageEvent("message", { data }));
      scope.importScripts = (...addresses) =>
        addresses.reduce((before, next) => before.then(() => load(scope.document, next)), Promise.resolve());
      this.#loaded = load(scope.document, address);
    }

    postMessage(data) {
      this.#loaded.then(() => this.#frame.contentWindow.dispatchEvent(new MessageEvent("message", { data })));
    }

    terminate() {
      this.#frame.remove();
    }
  };
}
