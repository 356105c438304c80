// MathJax 2 from this site: TeX between \( \) and \[ \], as the pages' formulas are handed over, drawn as SVG (no web fonts).
window.MathJax = {
  jax: ["input/TeX", "output/SVG"],
  extensions: ["tex2jax.js"],
  TeX: {extensions: ["AMSmath.js", "AMSsymbols.js"]},
  tex2jax: {inlineMath: [["\\(", "\\)"]], displayMath: [["\\[", "\\]"]], ignoreClass: ".*", processClass: "arithmatex"},
  SVG: {scale: 95},
  showMathMenu: false,
  messageStyle: "none",
};
