// A design in a link: compressed and written into the part behind the #, which browsers send to nobody.

const Share = {
  mark: "#design=",
  /** Characters of a link and bytes of a design at most: what is longer was not made here. */
  most: { link: 200000, design: 2000000 },

  async pack(opening) {
    const stream = new Blob([JSON.stringify(opening)]).stream().pipeThrough(new CompressionStream("deflate-raw"));
    const bytes = new Uint8Array(await new Response(stream).arrayBuffer());
    let text = "";
    for (const byte of bytes) text += String.fromCharCode(byte);
    return Share.mark + btoa(text).replaceAll("+", "-").replaceAll("/", "_").replace(/=+$/, "");
  },

  /** What the link holds; `null` where it holds none. Throws where it cannot be read. */
  async unpack(hash) {
    if (!hash.startsWith(Share.mark)) return null;
    if (hash.length > Share.most.link) throw new Error("it is too long");
    const text = atob(hash.slice(Share.mark.length).replaceAll("-", "+").replaceAll("_", "/"));
    const bytes = Uint8Array.from(text, (c) => c.charCodeAt(0));
    const reader = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate-raw")).getReader();
    const parts = [];
    let size = 0;
    for (;;) {
      const { done, value } = await reader.read();
      if (done) break;
      size += value.length;
      if (size > Share.most.design) {
        await reader.cancel();
        throw new Error("its design is too large");
      }
      parts.push(value);
    }
    const opening = JSON.parse(await new Blob(parts).text());
    if (typeof opening?.design !== "string") throw new Error("it holds no design");
    return { design: opening.design, trajectory: opening.trajectory || [], start: opening.start || null, at: opening.at || null };
  },
};
