// A folder as one file: tar (POSIX ustar), which all systems unpack.

const BLOCK = 512;

function header(path, size) {
  const bytes = new Uint8Array(BLOCK), text = new TextEncoder();
  const put = (at, value) => bytes.set(text.encode(value), at);
  put(0, path);
  put(100, "0000644\0");
  put(108, "0000000\0");
  put(116, "0000000\0");
  put(124, `${size.toString(8).padStart(11, "0")}\0`);
  put(136, "00000000000\0");
  put(148, "        ");
  put(156, "0");
  put(257, "ustar\x0000");
  const sum = bytes.reduce((total, byte) => total + byte, 0);
  put(148, `${sum.toString(8).padStart(6, "0")}\0 `);
  return bytes;
}

/** @param {{path: string, bytes: Uint8Array}[]} files */
export function toTar(files) {
  const parts = [];
  for (const { path, bytes } of files)
    parts.push(header(path, bytes.length), bytes, new Uint8Array((BLOCK - (bytes.length % BLOCK)) % BLOCK));
  parts.push(new Uint8Array(2 * BLOCK));
  return new Blob(parts, { type: "application/x-tar" });
}

export const isTar = (bytes) => bytes.length >= BLOCK && new TextDecoder().decode(bytes.subarray(257, 262)) === "ustar";

/** The files in it, without what else there may be. Throws an Error. */
export function fromTar(bytes) {
  const text = new TextDecoder(), files = [];
  const field = (at, size) => text.decode(bytes.subarray(at, at + size)).replace(/\0.*$/s, "");
  for (let at = 0; at + BLOCK <= bytes.length && bytes[at] !== 0; ) {
    const size = parseInt(field(at + 124, 12), 8), kind = field(at + 156, 1), prefix = field(at + 345, 155);
    if (!Number.isFinite(size) || at + BLOCK + size > bytes.length) throw new Error("the file breaks off");
    if (kind === "0" || kind === "")
      files.push({ path: (prefix ? `${prefix}/` : "") + field(at, 100), bytes: bytes.slice(at + BLOCK, at + BLOCK + size) });
    at += BLOCK * (1 + Math.ceil(size / BLOCK));
  }
  return files;
}
