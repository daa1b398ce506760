// A module for browsers that know more, as what it differs by from the other one: made by make-patch.mjs, which has the format.

/** Reads a number of seven bits a byte, lowest first, the eighth of each saying that there are more. */
class Reader {
  constructor(bytes) {
    this.bytes = bytes;
    this.at = 0;
  }
  number() {
    for (let value = 0, factor = 1; ; factor *= 128) {
      const byte = this.bytes[this.at++];
      if (byte === undefined) throw new Error("the module in this page is damaged");
      value += (byte & 127) * factor;
      if (byte < 128) return value;
    }
  }
  /** The same with a sign, which is the lowest bit. */
  signed() {
    const value = this.number();
    return value % 2 ? -(value + 1) / 2 : value / 2;
  }
  take(count) {
    return this.bytes.subarray(this.at, (this.at += count));
  }
}

/**
 * @param {Uint8Array} base
 * @param {Uint8Array} patch
 * @returns {Uint8Array} what the patch makes of it
 */
export function patched(base, patch) {
  const reader = new Reader(patch), made = new Uint8Array(reader.number());
  for (let at = 0, from = 0; at < made.length; ) {
    const fresh = reader.number();
    made.set(reader.take(fresh), at);
    at += fresh;
    from += reader.signed();
    const end = at + reader.number();
    made.set(base.subarray(from, from + end - at), at);
    from += end - at;
    while (at < end) {
      at += reader.number();
      for (let left = reader.number(); left > 0; --left) made[at++] += reader.bytes[reader.at++];
    }
  }
  return made;
}
