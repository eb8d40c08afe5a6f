// Holds the JSON Schema of scenes, as editors take it, to what the reader says: by ajv, and by taplo
// on TOML files. The cases are those of check_scenes.py.
//
// Usage: node check_scenes.cjs FILE
// Prints every case on which one of the two says otherwise. Exit code 0: none.
const { spawnSync } = require('node:child_process');
const fs = require('node:fs');
const os = require('node:os');
const path = require('node:path');
const { pathToFileURL } = require('node:url');
const Ajv = require('ajv-draft-04');

// The indices of the cases that ajv refuses.
function refusedByAjv(schema, cases) {
  const validate = new Ajv().compile(schema);
  return new Set([...cases.keys()].filter(i => !validate(cases[i].scene)));
}

// The same of taplo. It names the file of each error; a file that it does not name is accepted.
function refusedByTaplo(schema, cases) {
  const folder = fs.mkdtempSync(path.join(os.tmpdir(), 'scenes-'));
  try {
    const schemaFile = path.join(folder, 'schema.json');
    fs.writeFileSync(schemaFile, JSON.stringify(schema));
    const files = cases.map((_, i) => `case_${i}.toml`);
    files.forEach((file, i) => fs.writeFileSync(path.join(folder, file), cases[i].toml));
    const taplo = [require.resolve('@taplo/cli/dist/cli.js'), 'lint', '--no-auto-config', '--schema',
      pathToFileURL(schemaFile).href];
    const run = spawnSync(process.execPath, [...taplo, ...files],
      { cwd: folder, encoding: 'utf8', maxBuffer: 1 << 28 });
    const refused = new Set();
    for (const [, i] of (run.stdout + run.stderr).matchAll(/case_(\d+)\.toml/g)) {
      refused.add(Number(i));
    }
    if ((run.status === 0) !== (refused.size === 0)) {
      throw new Error(`taplo ended with ${run.status}: ${run.stderr}`);
    }
    return refused;
  } finally {
    fs.rmSync(folder, { recursive: true });
  }
}

const { schema, cases } = JSON.parse(fs.readFileSync(process.argv[2], 'utf8'));
let differing = 0;
for (const [checker, refused] of [
  ['ajv', refusedByAjv(schema, cases)],
  ['taplo', refusedByTaplo(schema, cases)],
]) {
  cases.forEach(({ name, accepted }, i) => {
    if (refused.has(i) === accepted) {
      ++differing;
      console.log(`${checker}: ${name} is ${accepted ? 'refused' : 'accepted'}`);
    }
  });
}
console.log(cases.length, 'cases,', differing, 'differ');
process.exit(differing > 0 ? 1 : 0);
