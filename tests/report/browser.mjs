// Debian's Chromium without a window, driven through a pipe by its DevTools protocol; nothing but Node.js is needed.
import { spawn } from 'node:child_process';
import { mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { pathToFileURL } from 'node:url';

/** Starts the browser. */
export async function launch(program) {
  const profile = mkdtempSync(join(tmpdir(), 'atrium-browser-'));
  const browser = spawn(program, ['--headless=new', '--no-sandbox', '--disable-dev-shm-usage', '--use-gl=angle', '--use-angle=swiftshader', '--enable-unsafe-swiftshader',
                                  '--hide-scrollbars', '--no-first-run', '--disable-extensions', '--disable-background-networking', '--remote-debugging-pipe', `--user-data-dir=${profile}`],
                        { stdio: ['ignore', 'ignore', 'pipe', 'pipe', 'pipe'], detached: true });
  let said = '';
  browser.stderr.on('data', (data) => { said += data; });
  const pending = new Map();
  const listeners = [];
  let id = 0;
  let rest = Buffer.alloc(0);
  browser.stdio[4].on('data', (data) => {
    rest = Buffer.concat([rest, data]);
    for (let end = rest.indexOf(0); end >= 0; end = rest.indexOf(0)) {
      const message = JSON.parse(rest.subarray(0, end).toString());
      rest = rest.subarray(end + 1);
      if (message.id) {
        const { resolve, reject } = pending.get(message.id);
        pending.delete(message.id);
        message.error ? reject(new Error(message.error.message)) : resolve(message.result);
      } else {
        for (const listener of listeners) listener(message);
      }
    }
  });
  browser.on('exit', () => { for (const { reject } of pending.values()) reject(new Error(`the browser ended: ${said.slice(-2000)}`)); });
  const send = (method, params = {}, sessionId = undefined) => new Promise((resolve, reject) => {
    pending.set(++id, { resolve, reject });
    browser.stdio[3].write(`${JSON.stringify({ id, method, params, sessionId })}\0`);
  });
  return {
    send, listeners,
    async close() {
      const ended = new Promise((resolve) => { browser.on('exit', resolve); });
      send('Browser.close').catch(() => {});
      await Promise.race([ended, new Promise((resolve) => { setTimeout(resolve, 5000).unref(); })]);
      try { process.kill(-browser.pid, 'SIGKILL'); } catch { /* all of its processes have ended */ }
      try { rmSync(profile, { recursive: true, force: true, maxRetries: 20, retryDelay: 100 }); } catch { /* it is in the folder of temporary files */ }
    },
  };
}

/** Opens a file in a tab of its own; `errors` gets what the console and the page complain of, `requests` what it asks for. */
export async function openPage(browser, file, { width = 1280, height = 900, dark = false, print = false, until = "document.documentElement.dataset.ready === 'yes'" } = {}) {
  const { targetId } = await browser.send('Target.createTarget', { url: 'about:blank' });
  const { sessionId } = await browser.send('Target.attachToTarget', { targetId, flatten: true });
  const send = (method, params) => browser.send(method, params, sessionId);
  const errors = [];
  const requests = [];
  browser.listeners.push((message) => {
    if (message.sessionId !== sessionId) return;
    const { method, params } = message;
    if (method === 'Runtime.exceptionThrown') errors.push(params.exceptionDetails.exception?.description ?? params.exceptionDetails.text);
    if (method === 'Runtime.consoleAPICalled' && ['error', 'warning', 'assert'].includes(params.type)) errors.push(params.args.map((a) => a.value ?? a.description).join(' '));
    if (method === 'Log.entryAdded' && ['error', 'warning'].includes(params.entry.level)) errors.push(params.entry.text);
    if (method === 'Network.requestWillBeSent') requests.push(params.request.url.slice(0, 80));
  });
  for (const domain of ['Page', 'Runtime', 'Log', 'Network']) await send(`${domain}.enable`);
  await send('Emulation.setDeviceMetricsOverride', { width, height, deviceScaleFactor: 1, mobile: false });
  await send('Emulation.setEmulatedMedia', { media: print ? 'print' : '', features: [{ name: 'prefers-color-scheme', value: dark ? 'dark' : 'light' }] });
  await send('Page.navigate', { url: pathToFileURL(file).href });
  const page = {
    errors, requests, send,
    async evaluate(expression) {
      const { result, exceptionDetails } = await send('Runtime.evaluate', { expression, awaitPromise: true, returnByValue: true });
      if (exceptionDetails) throw new Error(exceptionDetails.exception?.description ?? exceptionDetails.text);
      return result.value;
    },
    async waitFor(expression, seconds = 300) {  // patient: software rendering on a busy machine takes its time
      const end = Date.now() + seconds * 1000;
      while (Date.now() < end) {
        if (await page.evaluate(`Boolean(${expression})`).catch(() => false)) return;
        await new Promise((resolve) => { setTimeout(resolve, 50); });
      }
      throw new Error(`waited in vain for ${expression}; errors: ${errors.join('; ')}`);
    },
    async screenshot(target, selector = null) {
      let clip;
      if (selector) {
        const box = await page.evaluate(`(() => { const b = document.querySelector(${JSON.stringify(selector)}).getBoundingClientRect(); return { x: b.x + scrollX, y: b.y + scrollY, width: b.width, height: b.height }; })()`);
        clip = { ...box, scale: 1 };
      }
      const { data } = await send('Page.captureScreenshot', { format: 'png', clip, captureBeyondViewport: Boolean(clip) });
      const bytes = Buffer.from(data, 'base64');
      if (target) writeFileSync(target, bytes);
      return bytes;
    },
    key: (key) => send('Input.dispatchKeyEvent', { type: 'keyDown', key, code: key, windowsVirtualKeyCode: key === 'Enter' ? 13 : 0, text: key === 'Enter' ? '\r' : undefined })
      .then(() => send('Input.dispatchKeyEvent', { type: 'keyUp', key, code: key })),
    close: () => browser.send('Target.closeTarget', { targetId }),
  };
  await page.waitFor(until);
  return page;
}
