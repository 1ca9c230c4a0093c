// Runs the npm package gltf-validator on the bytes of standard input and prints its report:
// node khronos.js PACKAGE SETTINGS. Nothing is read but files inside the asset's own folder, and no network.
"use strict";

const fs = require("fs");
const path = require("path");

const validator = require(process.argv[2]);
const { folder, maxBytes, maxIssues, uri } = JSON.parse(process.argv[3]);
const root = folder === null ? null : fs.realpathSync(folder);

async function resource(name) {
  if (root === null) throw new Error("there is no folder to look in");
  if (/^[a-z][a-z0-9+.-]*:/i.test(name)) throw new Error("only files beside the asset are read");
  // Links are followed before the place is checked.
  const place = fs.realpathSync(path.join(root, decodeURIComponent(name)));
  const inside = path.relative(root, place);
  if (inside.split(path.sep)[0] === ".." || path.isAbsolute(inside)) throw new Error("it lies outside of the asset's folder");
  const status = fs.statSync(place);
  if (!status.isFile()) throw new Error("it is not a regular file");
  if (status.size > maxBytes) throw new Error("it is too large");
  return new Uint8Array(fs.readFileSync(place));
}

const options = { uri, maxIssues, writeTimestamp: false, externalResourceFunction: resource };
validator.validateBytes(new Uint8Array(fs.readFileSync(0)), options).then(
  (report) => fs.writeSync(1, JSON.stringify(report)),
  (error) => {
    fs.writeSync(2, String(error));
    process.exitCode = 1;
  },
);
