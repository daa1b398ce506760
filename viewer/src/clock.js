// The time that everything in the page shows.

export const SPEEDS = [0.1, 0.25, 0.5, 1, 2, 4];
export const FRAME_S = 0.02;

export class Clock {
  constructor(duration_s) {
    this.duration_s = duration_s;
    this.time_s = 0;
    this.playing = false;
    this.speed = 1;
    this.listeners = [];
    this.more = null; // of what is simulated: brings it to a time and gives the time that was reached
  }

  /** `listener` is called after every change. */
  listen(listener) {
    this.listeners.push(listener);
  }
  changed() {
    for (const listener of this.listeners) listener();
  }

  seek(time_s) {
    this.ahead_s = 0;
    this.time_s = Math.min(Math.max(time_s, 0), this.duration_s);
    this.changed();
  }
  /** By whole frames, onto the grid of frames. */
  step(frames) {
    this.playing = false;
    this.seek((Math.round(this.time_s / FRAME_S) + frames) * FRAME_S);
  }
  play() {
    if (this.duration_s === 0 && !this.more) return;
    if (this.time_s >= this.duration_s && !this.more) this.time_s = 0;
    this.playing = true;
    this.changed();
  }
  pause() {
    this.playing = false;
    this.changed();
  }
  toggle() {
    if (this.playing) this.pause();
    else this.play();
  }
  setSpeed(speed) {
    this.speed = speed;
    this.changed();
  }
  /** The next slower (−1) or faster (1) speed. */
  shiftSpeed(direction) {
    const at = SPEEDS.indexOf(this.speed) + direction;
    this.setSpeed(SPEEDS[Math.min(Math.max(at, 0), SPEEDS.length - 1)]);
  }

  /** `real_s` seconds have passed. */
  advance(real_s) {
    if (!this.playing) return;
    const aim_s = this.time_s + (this.ahead_s ?? 0) + real_s * this.speed;
    if (this.more && aim_s > this.duration_s) this.duration_s = this.more(aim_s);
    this.time_s = Math.min(aim_s, this.duration_s);
    if (this.more) this.ahead_s = Math.min(aim_s - this.time_s, FRAME_S); // what is less than a step is for the next frame
    else if (this.time_s === this.duration_s) this.playing = false;
    this.changed();
  }
}
