// The time shown by everything on the page.

class Clock {
  constructor(times) {
    this.times = times;
    this.first = times[0];
    this.last = times[times.length - 1];
    this.t = this.first;
    this.playing = false;
    this.speed = 1;
    this.place = { row: 0, share: 0 };
    this.listeners = [];
    this.frame = 0;
    this.find();
  }

  onChange(listener) {
    this.listeners.push(listener);
    listener(this);
    return () => (this.listeners = this.listeners.filter((one) => one !== listener));
  }

  tell() {
    for (const listener of this.listeners) listener(this);
  }

  set(t) {
    this.t = Math.min(this.last, Math.max(this.first, t));
    this.find();
    this.tell();
  }

  /** The row at or before the time, and the fraction of the way to the next. */
  find() {
    let low = 0, high = this.times.length;
    while (high - low > 1) {
      const middle = (low + high) >> 1;
      if (this.times[middle] <= this.t) low = middle;
      else high = middle;
    }
    const step = low + 1 < this.times.length ? this.times[low + 1] - this.times[low] : 0;
    this.place = { row: low, share: step > 0 ? (this.t - this.times[low]) / step : 0 };
  }

  step(rows) {
    this.pause();
    const row = this.place.row + (rows < 0 && this.place.share > 1e-6 ? rows + 1 : rows);
    this.set(this.times[Math.min(this.times.length - 1, Math.max(0, row))]);
  }

  toggle() {
    if (this.playing) this.pause();
    else this.play();
  }

  play() {
    if (this.last <= this.first) return;
    if (this.t >= this.last) this.t = this.first;
    this.playing = true;
    let before = null;
    const frame = (now) => {
      if (before !== null) {
        const span = this.last - this.first;
        const t = this.t + ((now - before) / 1000) * this.speed;
        this.set(t > this.last ? this.first + ((t - this.last) % span) : t);
      }
      before = now;
      this.frame = requestAnimationFrame(frame);
    };
    this.frame = requestAnimationFrame(frame);
    this.tell();
  }

  pause() {
    cancelAnimationFrame(this.frame);
    this.playing = false;
    this.tell();
  }
}
