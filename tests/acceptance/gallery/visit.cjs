// Opens pages of the gallery in Chromium at three widths, in light and in dark, and searches.
// Usage: node visit.cjs SITE CHROMIUM; prints what is wrong, and ends with 1 if anything is.
const path = require('node:path');
const { pathToFileURL } = require('node:url');
const { chromium } = require('playwright-core');

const [site, program] = process.argv.slice(2);
const address = page => pathToFileURL(path.join(site, page)).href;
// The pages of examples are looked at by their own tests: here, that they open.
const documents = ['index.html', 'README.html', 'host_sim/README.html', 'host_sim/scenes/keys.html',
  'firmware/control/README.html', 'host_sim/scenes/target_step.toml.html'];
const others = ['pages/target_step/report.html', 'pages/design/report.html', 'api/index.html'];
const widths = [400, 800, 1280];

async function look(browser, troubles) {
  let looks = 0;
  for (const colorScheme of ['light', 'dark']) {
    for (const width of widths) {
      const page = await browser.newPage({ viewport: { width, height: 900 }, colorScheme });
      const where = name => `${name}, ${width} px, ${colorScheme}`;
      let name = '';
      page.on('console', message => message.type() === 'error' &&
        troubles.push(`${where(name)}: ${message.text()}`));
      page.on('pageerror', error => troubles.push(`${where(name)}: ${error.message}`));
      page.on('request', request => /^https?:/.test(request.url()) &&
        troubles.push(`${where(name)}: asks for ${request.url()}`));
      for (name of [...documents, ...others]) {
        await page.goto(address(name));
        const over = await page.evaluate(() => document.documentElement.scrollWidth - innerWidth);
        if (over > 0 && documents.includes(name)) {
          troubles.push(`${where(name)}: ${over} px wider than the screen`);
        }
        if (documents.includes(name)) {
          const luminance = await page.evaluate(() =>
            getComputedStyle(document.body).backgroundColor.match(/\d+/g).reduce((a, b) => a + +b, 0) / 765);
          if ((luminance < 0.5) !== (colorScheme === 'dark')) {
            troubles.push(`${where(name)}: the background has luminance ${luminance}`);
          }
        }
        ++looks;
      }
      await page.close();
    }
  }
  return looks;
}

async function search(browser, troubles) {
  const page = await browser.newPage({ viewport: { width: 400, height: 900 } });
  await page.goto(address('host_sim/studies/sweep/README.html'));
  await page.fill('#search', 'anti-windup');
  const link = page.locator('#found a').first();
  const title = await link.textContent();
  await link.click();
  const heading = new URL(page.url()).hash.slice(1);
  if (!(await page.locator(`[id="${decodeURIComponent(heading)}"]`).count())) {
    troubles.push(`search: ${title} leads to ${page.url()}, which has no such place`);
  }
  await page.fill('#search', 'no such word xyzzy');
  if ((await page.textContent('#found')) !== 'Nothing found.') {
    troubles.push('search: an unknown word is found');
  }
}

(async () => {
  const browser = await chromium.launch({ executablePath: program, args: ['--no-sandbox', '--disable-gpu',
    '--disable-quic', '--no-first-run', '--disable-background-networking', '--disable-component-update',
    '--disable-sync'] });
  const troubles = [];
  const looks = await look(browser, troubles);
  await search(browser, troubles);
  await browser.close();
  troubles.forEach(each => console.log(each));
  console.log(`${looks} looks, ${troubles.length} troubles`);
  process.exit(troubles.length > 0 ? 1 : 0);
})();
