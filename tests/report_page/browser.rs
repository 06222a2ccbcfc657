//! A real headless Chromium, driven by the DevTools protocol.

use std::io::{BufRead, BufReader};
use std::net::TcpStream;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::sync::{Arc, Mutex, PoisonError, Weak};
use std::time::{Duration, Instant};

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use serde_json::{Value, json};
use tungstenite::{Message, WebSocket};

/// Time limit, far longer than anything here takes on a busy machine.
const PATIENCE: Duration = Duration::from_secs(60);

/// Options of a headless Chromium with pictures that are the same everywhere; a processor runs the
/// shaders of its pages.
const OPTIONS: &str = "--headless --no-sandbox --disable-gpu --hide-scrollbars --no-first-run --remote-debugging-port=0 \
                       --force-color-profile=srgb --enable-unsafe-webgpu --use-webgpu-adapter=swiftshader \
                       --disable-renderer-backgrounding --disable-background-timer-throttling \
                       --disable-backgrounding-occluded-windows";

/// Programs to look for on the PATH if the variable CHROMIUM names none.
const NAMES: [&str; 4] = ["chromium", "chromium-browser", "google-chrome", "chrome"];

/// Running Chromium, which ends with the last browser that uses it.
struct Chromium {
    process: Child,
    /// Address where it listens.
    address: String,
    _profile: tempfile::TempDir,
}

impl Chromium {
    fn start() -> Self {
        let profile = tempfile::tempdir().unwrap();
        let mut command = Command::new(program());
        command.args(OPTIONS.split_whitespace()).arg("about:blank");
        command.arg(format!("--user-data-dir={}", profile.path().display()));
        command.stdout(Stdio::null()).stderr(Stdio::piped());
        let mut process = command.spawn().unwrap();
        Self {
            address: read_address(&mut process),
            process,
            _profile: profile,
        }
    }

    /// Returns the Chromium that runs, or starts one.
    fn shared() -> Arc<Self> {
        static LAST: Mutex<Weak<Chromium>> = Mutex::new(Weak::new());
        let mut last = LAST.lock().unwrap_or_else(PoisonError::into_inner);
        last.upgrade().unwrap_or_else(|| {
            let chromium = Arc::new(Self::start());
            *last = Arc::downgrade(&chromium);
            chromium
        })
    }

    fn connect(&self) -> Option<WebSocket<TcpStream>> {
        let host = self.address.strip_prefix("ws://")?.split('/').next()?;
        let stream = TcpStream::connect(host).ok()?;
        stream.set_read_timeout(Some(PATIENCE)).ok()?;
        let (socket, _) = tungstenite::client(&self.address, stream).ok()?;
        Some(socket)
    }
}

/// Tab with a window, a cache and settings of its own.
pub struct Browser {
    socket: WebSocket<TcpStream>,
    session: Option<String>,
    calls: u64,
    /// Events in order: objects with `method` and `params`.
    pub events: Vec<Value>,
    _chromium: Arc<Chromium>,
}

impl Browser {
    /// Opens an empty tab of this size in pixels.
    pub fn new(width: u32, height: u32) -> Self {
        let chromium = Chromium::shared();
        let mut browser = Self {
            socket: chromium.connect().expect("Chromium listens"),
            session: None,
            calls: 0,
            events: Vec::new(),
            _chromium: chromium,
        };
        // Closed with the connection.
        let words = json!({"disposeOnDetach": true});
        let context = browser.call("Target.createBrowserContext", words);
        let words = json!({"url": "about:blank", "browserContextId": context["browserContextId"]});
        let target = browser.call("Target.createTarget", words);
        let target = json!({"targetId": target["targetId"], "flatten": true});
        let session = browser.call("Target.attachToTarget", target);
        browser.session = session["sessionId"].as_str().map(str::to_owned);
        // Several windows have the focus, each for its own page.
        let words = json!({"enabled": true});
        browser.call("Emulation.setFocusEmulationEnabled", words);
        for domain in ["Page", "Runtime", "Network", "Log"] {
            browser.call(&format!("{domain}.enable"), json!({}));
        }
        browser.resize(width, height);
        browser
    }

    /// Opens a file, or an address of http, at a part of it such as `#railing/bevy:high`.
    pub fn open(&mut self, page: &Path, part: &str) {
        let url = format!("{}{part}", address_of(page));
        self.call("Page.navigate", json!({"url": url}));
        self.until("document.readyState === 'complete'");
    }

    /// Lets pages save files to a folder.
    pub fn save_to(&mut self, folder: &Path) {
        let words = json!({"behavior": "allow", "downloadPath": folder});
        self.call("Page.setDownloadBehavior", words);
    }

    /// Evaluates an expression, and waits for promises; `$` and `$$` find the first element and all
    /// elements of a selector.
    pub fn value(&mut self, expression: &str) -> Value {
        let words = json!({"expression": expression, "returnByValue": true, "awaitPromise": true, "includeCommandLineAPI": true});
        let answer = self.call("Runtime.evaluate", words);
        let error = answer.get("exceptionDetails");
        assert!(error.is_none(), "{expression}: {answer}");
        answer["result"]["value"].clone()
    }

    /// Evaluates an expression that is a text.
    pub fn text(&mut self, expression: &str) -> String {
        let value = self.value(expression);
        let text = value.as_str().map(str::to_owned);
        text.unwrap_or_else(|| panic!("{expression}: {value}"))
    }

    /// Returns the text of the first element that a selector finds.
    pub fn read(&mut self, selector: &str) -> String {
        self.text(&format!("$('{selector}').textContent"))
    }

    /// Clicks the first element that a selector finds.
    pub fn click(&mut self, selector: &str) {
        self.value(&format!("$('{selector}').click()"));
    }

    /// Returns whether the first element that a selector finds is visible.
    pub fn shows(&mut self, selector: &str) -> bool {
        self.value(&format!("$('{selector}').checkVisibility()")) == true
    }

    /// Waits until an expression is true.
    pub fn until(&mut self, expression: &str) {
        let start = Instant::now();
        while self.value(expression) != true {
            assert!(start.elapsed() < PATIENCE, "never: {expression}");
            std::thread::sleep(Duration::from_millis(10));
        }
    }

    /// Presses and releases a key, named as in `KeyboardEvent.key`.
    pub fn press(&mut self, key: &str) {
        let text = if key.chars().count() == 1 { key } else { "" };
        for (kind, text) in [("keyDown", text), ("keyUp", "")] {
            let words = json!({"type": kind, "key": key, "text": text});
            self.call("Input.dispatchKeyEvent", words);
        }
    }

    /// Moves the mouse to a position in the window, in pixels.
    pub fn point(&mut self, x: f64, y: f64) {
        self.mouse("mouseMoved", x, y);
    }

    /// Presses the mouse at a position, moves to another one, and releases it.
    pub fn drag(&mut self, from: [f64; 2], to: [f64; 2]) {
        self.mouse("mousePressed", from[0], from[1]);
        self.mouse("mouseMoved", to[0], to[1]);
        self.mouse("mouseReleased", to[0], to[1]);
    }

    fn mouse(&mut self, kind: &str, x: f64, y: f64) {
        let pressed = u32::from(kind != "mouseReleased");
        let words = json!({"type": kind, "x": x, "y": y, "button": "left", "buttons": pressed, "clickCount": 1});
        self.call("Input.dispatchMouseEvent", words);
    }

    /// Turns the wheel at a position; up is below 0.
    pub fn turn_wheel(&mut self, x: f64, y: f64, down: f64) {
        let words = json!({"type": "mouseWheel", "x": x, "y": y, "deltaX": 0, "deltaY": down});
        self.call("Input.dispatchMouseEvent", words);
    }

    /// Resizes the window to a screen of this size in pixels.
    pub fn resize(&mut self, width: u32, height: u32) {
        let screen =
            json!({"width": width, "height": height, "deviceScaleFactor": 1, "mobile": false});
        self.call("Emulation.setDeviceMetricsOverride", screen);
    }

    /// Shows pages as in print.
    pub fn print(&mut self) {
        self.call("Emulation.setEmulatedMedia", json!({"media": "print"}));
    }

    /// Shows pages in a colour scheme, `light` or `dark`.
    pub fn prefer(&mut self, scheme: &str) {
        let features = json!([{"name": "prefers-color-scheme", "value": scheme}]);
        self.call("Emulation.setEmulatedMedia", json!({"features": features}));
    }

    /// Returns the page as PDF.
    pub fn paper(&mut self) -> Vec<u8> {
        let words = json!({"printBackground": false, "preferCSSPageSize": true});
        let printed = self.call("Page.printToPDF", words);
        STANDARD.decode(printed["data"].as_str().unwrap()).unwrap()
    }

    /// Returns left, top, width and height of the first element that a selector finds, in the
    /// window.
    pub fn place(&mut self, selector: &str) -> [f64; 4] {
        let place = self.value(&format!(
            "(() => {{ const box = $('{selector}').getBoundingClientRect(); \
             return [box.left, box.top, box.width, box.height]; }})()"
        ));
        [0, 1, 2, 3].map(|at| place[at].as_f64().unwrap())
    }

    /// Takes a PNG of an element.
    pub fn picture(&mut self, selector: &str) -> Vec<u8> {
        let [x, y, width, height] = self.place(selector);
        let [left, top] = ["scrollX", "scrollY"].map(|name| self.value(name).as_f64().unwrap());
        self.picture_at([x + left, y + top, width, height])
    }

    /// Takes a PNG of the page from its top, at most `most` pixels high.
    pub fn picture_of_page(&mut self, most: f64) -> Vec<u8> {
        let [_, _, width, height] = self.place("html");
        self.picture_at([0.0, 0.0, width, height.min(most)])
    }

    /// Takes a PNG of a part of the page: left, top, width and height.
    pub fn picture_at(&mut self, [x, y, width, height]: [f64; 4]) -> Vec<u8> {
        let clip = json!({"x": x, "y": y, "width": width, "height": height, "scale": 1});
        let words = json!({"clip": clip, "captureBeyondViewport": true});
        let shot = self.call("Page.captureScreenshot", words);
        STANDARD.decode(shot["data"].as_str().unwrap()).unwrap()
    }

    /// Returns the page's complaints: errors, warnings and refused requests.
    pub fn complaints(&mut self) -> Vec<String> {
        const COMPLAINTS: &str = "Runtime.exceptionThrown Runtime.consoleAPICalled Log.entryAdded Page.javascriptDialogOpening";
        // All earlier events have arrived before this answer.
        self.value("0");
        let is_complaint = |event: &&Value| {
            COMPLAINTS
                .split(' ')
                .any(|method| event["method"] == method)
        };
        let complaints = self.events.iter().filter(is_complaint);
        complaints.map(Value::to_string).collect()
    }

    /// Returns the addresses of all requests, except for embedded pictures.
    pub fn requests(&mut self) -> Vec<String> {
        self.value("0");
        let is_sent = |event: &&Value| event["method"] == "Network.requestWillBeSent";
        let sent = self.events.iter().filter(is_sent);
        let urls = sent.filter_map(|event| event["params"]["request"]["url"].as_str());
        let urls = urls.filter(|url| !url.starts_with("data:"));
        urls.map(str::to_owned).collect()
    }

    fn call(&mut self, method: &str, params: Value) -> Value {
        self.calls += 1;
        let mut message = json!({"id": self.calls, "method": method, "params": params});
        if let Some(session) = &self.session {
            message["sessionId"] = json!(session);
        }
        let message = Message::text(message.to_string());
        self.socket.send(message).unwrap();
        loop {
            let Message::Text(text) = self.socket.read().unwrap() else {
                continue;
            };
            let heard: Value = serde_json::from_str(&text).unwrap();
            if heard["id"] == self.calls {
                // A page that is being left has no value; `until` asks the next one.
                let error = heard["error"]["message"].as_str().unwrap_or_default();
                let is_known = ["", "Inspected target navigated or closed"].contains(&error);
                assert!(is_known, "{method}: {heard}");
                return heard["result"].clone();
            }
            if heard["method"] == "Page.javascriptDialogOpening" {
                // After that nothing answers any more; the event that it opened is kept.
                let close = json!({"id": 0, "method": "Page.handleJavaScriptDialog", "sessionId": self.session,
                    "params": {"accept": false}});
                self.socket.send(Message::text(close.to_string())).unwrap();
            }
            self.events.push(heard);
        }
    }
}

impl Drop for Chromium {
    fn drop(&mut self) {
        let close = json!({"id": 0, "method": "Browser.close"});
        let mut socket = self.connect();
        let sent = (socket.as_mut())
            .is_some_and(|socket| socket.send(Message::text(close.to_string())).is_ok());
        let start = Instant::now();
        while sent && start.elapsed() < Duration::from_secs(5) {
            if let Ok(Some(_)) = self.process.try_wait() {
                return;
            }
            std::thread::sleep(Duration::from_millis(20));
        }
        let _ = self.process.kill();
        let _ = self.process.wait();
    }
}

fn program() -> PathBuf {
    if let Some(named) = std::env::var_os("CHROMIUM") {
        return PathBuf::from(named);
    }
    let path = std::env::var_os("PATH").unwrap_or_default();
    let folders: Vec<PathBuf> = std::env::split_paths(&path).collect();
    let files = NAMES
        .iter()
        .flat_map(|name| folders.iter().map(move |folder| folder.join(name)));
    let program = files.into_iter().find(|file| file.is_file());
    program.unwrap_or_else(|| {
        panic!(
            "no Chromium on the PATH ({}), and reports cannot be looked at without one: apt-get install chromium, as `make \
             test` does, or name one in the variable CHROMIUM",
            NAMES.join(", ")
        )
    })
}

/// Reads the address where Chromium listens.
fn read_address(process: &mut Child) -> String {
    let mut said = Vec::new();
    let mut lines = BufReader::new(process.stderr.take().unwrap()).lines();
    for line in lines.by_ref().map_while(Result::ok) {
        if let Some(address) = line.strip_prefix("DevTools listening on ") {
            let address = address.to_owned();
            // Chromium would stop if nobody read the rest of its output.
            std::thread::spawn(move || lines.for_each(drop));
            return address;
        }
        said.push(line);
    }
    panic!("Chromium ended before it listened: {}", said.join("\n"));
}

/// Formats a path, or an address of http, as a browser's address line does.
pub fn address_of(page: &Path) -> String {
    let escapes = [(' ', "%20"), ('#', "%23"), ('<', "%3C"), ('>', "%3E")];
    let path = page.to_str().unwrap().to_owned();
    let escaped =
        (escapes.iter()).fold(path, |path, (letter, escape)| path.replace(*letter, escape));
    if escaped.starts_with("http:") {
        escaped
    } else {
        format!("file://{escaped}")
    }
}
