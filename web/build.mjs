// Bundles the page, and its logic alone for tests, into the folder that the command line names: node build.mjs FOLDER
import {build} from "esbuild";
import {copyFile} from "node:fs/promises";

const folder = process.argv[2];
const common = {bundle: true, target: "es2022", charset: "utf8", legalComments: "none", outdir: folder, logLevel: "warning"};
await build({
    ...common,
    entryPoints: {app: "src/main.tsx", style: "src/style.css"},
    minify: true,
    banner: {js: "/* with Preact and uPlot, MIT licence */", css: "/* with uPlot, MIT licence */"},
});
await build({...common, entryPoints: ["src/scale.ts", "src/state.ts", "src/words.ts", "src/residuals.ts", "src/differences.ts", "src/measurement.ts"], format: "esm"});
for (const file of ["index.html", "icon.svg"]) await copyFile(`src/${file}`, `${folder}/${file}`);
