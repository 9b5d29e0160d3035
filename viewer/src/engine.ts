/** The WebAssembly of groebot. Requests and responses are JSON, specified in viewer/wasm/src/session.rs. */

interface Exports {
  memory: WebAssembly.Memory;
  /** Allocates memory for a request of this number of bytes. */
  allocate(bytes: number): number;
  /** Processes the request. Returns the address of the response. */
  call(): number;
  /** Length of the response in bytes. */
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

  /** Sends a request and returns the response; throws an Error with the reason if it is refused. */
  request<Answer>(request: unknown): Answer {
    const text = this.encoder.encode(JSON.stringify(request));
    const place = this.exports.allocate(text.length);
    new Uint8Array(this.exports.memory.buffer, place, text.length).set(text);
    const answer = this.exports.call();
    const response = this.decoder.decode(new Uint8Array(this.exports.memory.buffer, answer, this.exports.length()));
    const read = JSON.parse(response);
    if (read.error !== undefined) throw new Error(read.error);
    return read;
  }
}
