// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT

import { defineConfig } from "vite";

export default defineConfig({
  base: "./", // works under any path
  build: { target: "es2022", modulePreload: { polyfill: false }, chunkSizeWarningLimit: 1000, assetsInlineLimit: 0 },
  worker: { format: "es" },
});
