/** What computes in the page: WebAssembly of groebot, asked in JSON as viewer/wasm/src/desk.rs says. */

interface Exports {
  memory: WebAssembly.Memory;
  /** Room for a request of so many bytes. */
  allocate(bytes: number): number;
  /** Answers the request; where the answer is. */
  call(): number;
  /** How long it is. */
  length(): number;
}

export class Engine {
  private readonly encoder = new TextEncoder();
  private readonly decoder = new TextDecoder();

  private constructor(private readonly exports: Exports) {}

  static async start(program: ArrayBuffer): Promise<Engine> {
    const { instance } = await WebAssembly.instantiate(program, {});
    return new Engine(instance.exports as unknown as Exports);
  }

  /** The answer to a request; throws an Error with the reason where there is none. */
  ask<Answer>(request: unknown): Answer {
    const text = this.encoder.encode(JSON.stringify(request));
    const place = this.exports.allocate(text.length);
    new Uint8Array(this.exports.memory.buffer, place, text.length).set(text);
    const answer = this.exports.call();
    const told = this.decoder.decode(new Uint8Array(this.exports.memory.buffer, answer, this.exports.length()));
    const read = JSON.parse(told);
    if (read.error !== undefined) throw new Error(read.error);
    return read;
  }
}
