// Decimals in bytes, read to the double that they stand for.

const POWERS = Array.from({ length: 23 }, (_, k) => Number(`1e${k}`));
const ZERO = 48, NINE = 57, MINUS = 45, PLUS = 43, POINT = 46, SMALL_E = 101, LARGE_E = 69;

/** The number that stands in bytes[begin, end), or NaN. */
export function numberAt(bytes, begin, end) {
  let i = begin, mantissa = 0, digits = 0, scale = 0, sign = 1;
  if (bytes[i] === MINUS) {
    sign = -1;
    ++i;
  }
  let pointed = false;
  for (; i < end; ++i) {
    const c = bytes[i];
    if (c >= ZERO && c <= NINE) {
      mantissa = 10 * mantissa + (c - ZERO);
      if (mantissa > 0) ++digits;
      if (pointed) --scale;
    } else if (c === POINT && !pointed) {
      pointed = true;
    } else {
      break;
    }
  }
  let exponent = 0;
  if (i < end && (bytes[i] === SMALL_E || bytes[i] === LARGE_E)) {
    let negative = false;
    ++i;
    if (bytes[i] === MINUS || bytes[i] === PLUS) negative = bytes[i++] === MINUS;
    for (; i < end && bytes[i] >= ZERO && bytes[i] <= NINE; ++i) exponent = 10 * exponent + (bytes[i] - ZERO);
    if (negative) exponent = -exponent;
  }
  if (i !== end || end === begin) return NaN;
  const power = scale + exponent;
  // Both factors are exact, so that their product or quotient is rounded once (Clinger 1990).
  if (digits <= 15 && power >= -22 && power <= 22) {
    return sign * (power < 0 ? mantissa / POWERS[-power] : mantissa * POWERS[power]);
  }
  return Number(textOf(bytes, begin, end));
}

export function textOf(bytes, begin, end) {
  let text = "";
  for (let i = begin; i < end; ++i) text += String.fromCharCode(bytes[i]);
  return text;
}
