// Tables as RFC 4180 has them.

/** {columns, rows}: all texts. */
export function readTable(text) {
  const rows = [[]];
  let field = '';
  let quoted = false;
  for (let i = 0; i < text.length; ++i) {
    const c = text[i];
    if (quoted) {
      if (c === '"' && text[i + 1] === '"') { field += '"'; ++i; }
      else if (c === '"') quoted = false;
      else field += c;
    } else if (c === '"') quoted = true;
    else if (c === ',' || c === '\n') {
      rows.at(-1).push(field);
      field = '';
      if (c === '\n') rows.push([]);
    } else if (c !== '\r') field += c;
  }
  if (field !== '' || rows.at(-1).length > 0) rows.at(-1).push(field);
  else rows.pop();
  const [columns = [], ...rest] = rows;
  return { columns, rows: rest };
}
