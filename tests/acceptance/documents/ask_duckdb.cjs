// Carries out SQL statements and prints the rows of the last one.
// Usage: node ask_duckdb.cjs STATEMENTS
const { DuckDBInstance } = require('@duckdb/node-api');

(async () => {
  const connection = await (await DuckDBInstance.create()).connect();
  const rows = (await connection.runAndReadAll(process.argv[2])).getRows();
  rows.forEach(row => console.log(row.join(' ')));
})();
