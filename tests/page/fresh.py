"""The module in the page answers as the program does: the checked-in core is that of the present sources."""

COMPARE = r"""async () => {
  const packed = Uint8Array.from(atob(document.getElementById('core').textContent.trim()), (c) => c.charCodeAt(0));
  const bytes = await new Response(new Blob([packed]).stream().pipeThrough(new DecompressionStream('gzip'))).arrayBuffer();
  const module = await WebAssembly.compile(bytes);
  const imports = {};
  for (const { module: from, name } of WebAssembly.Module.imports(module)) (imports[from] ||= {})[name] = () => { throw 1; };
  const doors = new WebAssembly.Instance(module, imports).exports;
  const call = (door, text) => {
    const input = new TextEncoder().encode(text);
    // the memory may grow in a call: its buffer is looked up after it
    const place = doors.equipod_input(input.length);
    new Uint8Array(doors.memory.buffer, place, input.length).set(input);
    const length = doors[door]();
    const from = doors.equipod_output();
    return new TextDecoder().decode(new Uint8Array(doors.memory.buffer, from, length));
  };
  const data = JSON.parse(document.getElementById('data').textContent);
  const kept = data.recorded;
  const refused = call('equipod_open', JSON.stringify(data.opening));
  if (refused) return [refused];
  const ask = (request) => JSON.parse(call('equipod_answer', JSON.stringify(request)));
  const apart = [];
  const compare = (a, b, where) => {
    if (typeof a === 'number' && typeof b === 'number') {
      // residuals and determinants at singular poses are rounding, and rounding differs between processors
      let gap = Math.abs(a - b);
      // angles of a pose, degrees: half a turn has two of them
      if (/\.written\.[345]$/.test(where)) gap = Math.min(gap, Math.abs(360 - gap));
      if (gap > 1e-7 * Math.max(1, Math.abs(a), Math.abs(b))) apart.push(`${where}: ${a} and ${b}`);
    } else if (a && b && typeof a === 'object' && typeof b === 'object') {
      const keys = new Set([...Object.keys(a), ...Object.keys(b)]);
      for (const key of keys) compare(a[key], b[key], `${where}.${key}`);
    } else if (a !== b) apart.push(`${where}: ${JSON.stringify(a)} and ${JSON.stringify(b)}`);
  };
  const chosen = data.opening.start;
  compare(kept.open, ask({ op: 'open' }), 'open');
  kept.frames.forEach((frame, k) => {
    compare(frame.pose, ask({ op: 'path', at: k / kept.frames.length }).pose, `path ${k}`);
    compare(frame, ask({ op: 'state', pose: frame.pose, chosen }), `state ${k}`);
  });
  compare(kept.worst, ask({ op: 'worst', chosen }), 'worst');
  compare(kept.modes, ask({ op: 'modes', pose: kept.open.home, which: 'first' }), 'modes');
  if (kept.plane) compare(kept.plane, ask({ op: 'plane', chosen, axes: [0, 1], range: [-0.5, 1.5], points: kept.plane.points }), 'plane');
  for (const which of ['first', 'second']) {
    if (kept.designs[which]) compare(kept.designs[which], ask({ op: 'design', which, chosen }), which);
  }
  return apart;
}"""


def same_answers(shown):
    apart = shown.page.evaluate(COMPARE)
    assert not apart, f"the core in the page is not that of the program; run tests/page/build-core: {apart[:5]}"
