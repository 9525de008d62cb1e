// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT

// The files of directories that a user drops or chooses.

/** A file, with its path below the directory that was dropped. */
export interface Dropped {
  path: string;
  file: File;
}

/** Files that the user chose. */
export function chosenFiles(list: Iterable<File>): Dropped[] {
  return [...list].map((file) => ({ path: file.webkitRelativePath || file.name, file }));
}

/** Files and the contents of directories. Call it in the event itself: the browser empties `transfer` afterwards. */
export async function droppedFiles(transfer: DataTransfer): Promise<Dropped[]> {
  const items = [...transfer.items].map((item) => {
    const entry = item.webkitGetAsEntry();
    const file = item.getAsFile();
    if (entry !== null) return filesOf(entry);
    return file === null ? [] : chosenFiles([file]);
  });
  return (await Promise.all(items)).flat();
}

async function filesOf(entry: FileSystemEntry): Promise<Dropped[]> {
  const path = entry.fullPath.replace(/^\//, "");
  if (entry.isFile) return [{ path, file: await settled<File>(entry, (done, failed) => (entry as FileSystemFileEntry).file(done, failed)) }];
  const reader = (entry as FileSystemDirectoryEntry).createReader();
  const files: Dropped[] = [];
  for (;;) {
    // Browsers return the entries of a directory in parts.
    const part = await settled<FileSystemEntry[]>(entry, (done, failed) => reader.readEntries(done, failed));
    if (part.length === 0) return files;
    files.push(...(await Promise.all(part.map(filesOf))).flat());
  }
}

function settled<T>(entry: FileSystemEntry, call: (done: (value: T) => void, failed: () => void) => void): Promise<T> {
  return new Promise((resolve, reject) => {
    call(resolve, () => reject(new Error(`${entry.name}: cannot be read (if it was moved, open it again)`)));
  });
}
