// Checks GLB files with the Khronos validator: no error and no warning is allowed.
//
//     node validate_glb.mjs FOLDER-WITH-node_modules FILE…
//
// Ends with the line `N passed, N failed`, which counts files.
import { createRequire } from 'node:module';
import { readFile } from 'node:fs/promises';
import { dirname, resolve } from 'node:path';

const [modules, ...files] = process.argv.slice(2);
if (!modules) {
  console.error('usage: node validate_glb.mjs FOLDER-WITH-node_modules FILE…');
  process.exit(2);
}
const validator = createRequire(resolve(modules) + '/')('gltf-validator');
const severities = ['error', 'warning'];

async function problems(file) {
  const report = await validator.validateBytes(new Uint8Array(await readFile(file)), {
    uri: file,
    maxIssues: 20,
    externalResourceFunction: async (uri) =>
      new Uint8Array(await readFile(resolve(dirname(file), decodeURIComponent(uri)))),
  });
  return report.issues.messages
    .filter((m) => m.severity < severities.length)
    .map((m) => `${severities[m.severity]} ${m.code} at ${m.pointer ?? m.offset}: ${m.message}`);
}

let passed = 0;
let failed = 0;
for (const file of files) {
  const found = await problems(file).catch((e) => [String(e)]);
  if (found.length === 0) {
    passed++;
  } else {
    failed++;
    console.log(`FAILED ${file}\n    ${found.join('\n    ')}`);
  }
}
if (files.length === 0) {
  console.log('FAILED no file to validate');
  failed++;
}
console.log(`${passed} passed, ${failed} failed`);
process.exit(failed ? 1 : 0);
