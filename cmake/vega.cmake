# Joins Vega's modules into one script that defines `vega` with View and parse. Each module gets the modules that it requires by
# name, as from a bundler: as plain scripts side by side they would overwrite one another.
# Usage: cmake -DFOLDER=/usr/share/javascript/vega -DMODULES=util;canvas -DOUTPUT=vega.js -P vega.cmake
set(text "(function () {\nconst modules = {};\n")
# One package requires another by its former name.
string(APPEND text "const require = (name) => modules[name === 'vega-selections' ? 'vega-selection' : name];\n")
foreach(module IN LISTS MODULES)
  file(READ "${FOLDER}/vega-${module}.min.js" content)
  # Developer tools would request a missing file.
  string(REGEX REPLACE "//# sourceMappingURL=[^\n]*" "" content "${content}")
  string(APPEND text "(function (exports, module) {\n${content}\n})((modules['vega-${module}'] = {}), {});\n")
endforeach()
string(APPEND text "const transforms = modules['vega-dataflow'].transforms;\n")
string(APPEND text "for (const name of ['transforms', 'view-transforms', 'encode', 'label']) Object.assign(transforms, modules['vega-' + name]);\n")
string(APPEND text "window.vega = { View: modules['vega-view'].View, parse: modules['vega-parser'].parse };\n})();\n")
file(WRITE "${OUTPUT}" "${text}")
