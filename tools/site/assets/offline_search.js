// A page of the file system may not start a worker. This one, with the same interface, runs the script of the search in a
// hidden frame. The theme knows it by its name and then finds its languages from there.
if (location.protocol === "file:") {
  class IFrameWorker extends EventTarget {
    constructor(script) {
      super();
      const frame = document.createElement("iframe");
      frame.hidden = true;
      document.body.appendChild(frame);
      this.inside = frame.contentWindow;
      this.inside.postMessage = data => this.dispatchEvent(new MessageEvent("message", {data}));
      this.inside.importScripts = (...urls) => urls.reduce((before, url) => before.then(() => this.run(url)), Promise.resolve());
      this.ready = this.run(String(script));
    }

    run(url) {
      return new Promise((done, failed) => {
        const element = this.inside.document.createElement("script");
        element.src = new URL(url, location);
        element.onload = done;
        element.onerror = failed;
        this.inside.document.body.appendChild(element);
      });
    }

    postMessage(data) {
      this.ready.then(() => this.inside.dispatchEvent(new MessageEvent("message", {data})));
    }

    terminate() {
      this.inside.frameElement.remove();
    }
  }
  window.IFrameWorker = window.Worker = IFrameWorker;
}
