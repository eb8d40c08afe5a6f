'use strict';

// Numbers with SI prefixes, and labels with their units.
const Numbers = (() => {
  const prefixes = {
    '-15': 'f', '-12': 'p', '-9': 'n', '-6': 'µ', '-3': 'm', '3': 'k', '6': 'M', '9': 'G',
  };
  const takesPrefix = /^(m|s|N|Hz|V|A|W|J|Pa|S|F|H)(?=$|[/·])/;

  const superscript = (integer) =>
      String(integer).replace(/[-0-9]/g, (c) => '⁻⁰¹²³⁴⁵⁶⁷⁸⁹'['-0123456789'.indexOf(c)]);

  // A typographic minus, and none before a zero.
  const withMinus = (text) =>
      Number(text) === 0 ? text.replace('-', '') : text.replace('-', '−');

  const parseLabel = (label) => {
    const parts = /^(.*?)\s*\[([^\]]*)\]\s*$/.exec(label);
    return parts ? {name: parts[1], unit: parts[2]} : {name: label, unit: ''};
  };

  // The power of ten to divide by so that numbers up to `largest` stay short, and the unit that
  // then belongs to them.
  const scaleFor = (largest, unit) => {
    const exponent = largest > 0 ? 3 * Math.floor(Math.floor(Math.log10(largest) + 1e-9) / 3) : 0;
    const prefixed = takesPrefix.test(unit);
    const short = prefixed ? largest >= 0.1 && largest < 1e4 : largest >= 1e-3 && largest < 1e5;
    if (exponent === 0 || short) return {exponent: 0, unit};
    if (prefixed && exponent in prefixes) return {exponent, unit: prefixes[exponent] + unit};
    const power = '10' + superscript(exponent);
    return {exponent, unit: unit === '' || unit === '-' ? power : `${power} ${unit}`};
  };

  const scaled = (value, scale) => value / Number(`1e${scale.exponent}`);

  const axisName = (quantity, scale) =>
      scale.unit === '' ? quantity.name : `${quantity.name} [${scale.unit}]`;

  const largestOf = ([low, high]) => Math.max(Math.abs(low), Math.abs(high));

  // A value in the unit of an axis that shows `range`, to a ten-thousandth of its width.
  const reading = (value, range, unit) => {
    if (value === null || !Number.isFinite(value)) return '–';
    const scale = scaleFor(largestOf(range), unit);
    const span = Math.abs(scaled(range[1] - range[0] || largestOf(range) || 1, scale));
    const decimals = Math.min(Math.max(4 - Math.floor(Math.log10(span)), 0), 12);
    const shownUnit = scale.unit === '-' || scale.unit === '' ? '' : ` ${scale.unit}`;
    return withMinus(scaled(value, scale).toFixed(decimals)) + shownUnit;
  };

  // ---- Ticks: places with their texts -------------------------------------------------------

  const niceStep = (rough) => {
    const decade = Math.pow(10, Math.floor(Math.log10(rough)));
    return [1, 2, 5, 10].map((m) => m * decade).find((step) => step >= rough * 0.999);
  };

  // @param least  smallest step; 1 on an axis of whole numbers
  const linearTicks = ([low, high], count, scale, least = 0) => {
    if (!(high > low)) return [{at: low, text: withMinus(String(scaled(low, scale)))}];
    const step = Math.max(least, niceStep((high - low) / count));
    const decimals = Math.max(0, -Math.floor(Math.log10(scaled(step, scale)) + 1e-9));
    const ticks = [];
    for (let i = Math.ceil(low / step - 1e-9); i <= high / step + 1e-9; ++i) {
      const text = scaled(i * step, scale).toFixed(Math.min(decimals, 12));
      ticks.push({at: i * step, text: withMinus(text)});
    }
    return ticks;
  };

  const decadeTicks = ([low, high], count) => {
    const first = Math.ceil(Math.log10(low) - 1e-9);
    const last = Math.floor(Math.log10(high) + 1e-9);
    const stride = Math.ceil((last - first + 1) / count);
    const ticks = [];
    for (let exponent = first; exponent <= last; ++exponent) {
      ticks.push({
        at: Number(`1e${exponent}`),
        text: exponent % stride === 0 ? '10' + superscript(exponent) : '',
      });
    }
    return ticks;
  };

  const oneTwoFiveTicks = ([low, high], scale) => {
    const ticks = [];
    for (let e = Math.floor(Math.log10(low)); e <= Math.log10(high); ++e) {
      for (const mantissa of [1, 2, 5]) {
        const at = Number(`${mantissa}e${e}`);
        if (at >= low && at <= high) {
          ticks.push({at, text: String(Number(scaled(at, scale).toPrecision(6)))});
        }
      }
    }
    return ticks;
  };

  // Of an axis that shows `range`, with the scale that names it. Over decades, powers of ten
  // without a prefix.
  // @param shown  its ends, the larger one first on an axis that falls
  const ticksOf = (axis, shown, count) => {
    const range = [...shown].sort((a, b) => a - b);
    const scale = scaleFor(largestOf(range), axis.quantity.unit);
    if (!axis.logarithmic) {
      return {scale, ticks: linearTicks(range, Math.max(2, count), scale, axis.whole ? 1 : 0)};
    }
    if (range[1] / range[0] >= 1e3) {
      const none = {exponent: 0, unit: axis.quantity.unit};
      return {scale: none, ticks: decadeTicks(range, Math.max(2, count))};
    }
    const ticks = oneTwoFiveTicks(range, scale);
    return {scale, ticks: ticks.length >= 2 ? ticks : linearTicks(range, Math.max(2, count), scale)};
  };

  return {parseLabel, axisName, largestOf, reading, ticksOf, withMinus};
})();
