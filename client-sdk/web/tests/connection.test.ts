import { afterEach, expect, it, vi } from 'vitest';
import { WebSocket as NodeSocket, WebSocketServer } from 'ws';
import type { AddressInfo } from 'node:net';
import { Connection, kSubprotocol, waitBefore, type Listener } from '../src/wire/connection';

const ends: (() => void)[] = [];
afterEach(() => ends.splice(0).forEach((end) => end()));

function serve(port = 0): { server: WebSocketServer; port: Promise<number> } {
  const server = new WebSocketServer({ port, host: '127.0.0.1', handleProtocols: (asked) => asked.has(kSubprotocol) && kSubprotocol });
  ends.push(() => {
    server.clients.forEach((client) => client.terminate());
    server.close();
  });
  return { server, port: new Promise((done) => server.on('listening', () => done((server.address() as AddressInfo).port))) };
}

function listen(): { [K in keyof Listener]: ReturnType<typeof vi.fn<Listener[K]>> } {
  return { opened: vi.fn(), text: vi.fn(), bytes: vi.fn(), closed: vi.fn() };
}

function connect(port: number, listener: Listener): Connection {
  const connection = new Connection(`ws://127.0.0.1:${port}/`, listener, NodeSocket as unknown as typeof WebSocket);
  ends.push(() => connection.end());
  return connection;
}

it('hears text and bytes, and says JSON', async () => {
  const { server, port } = serve();
  const heard: string[] = [];
  server.on('connection', (socket) => {
    socket.on('message', (message) => heard.push(String(message)));
    socket.send('{"type":"hello"}');
    socket.send(new Uint8Array([1, 2]));
  });
  const listener = listen();
  const connection = connect(await port, listener);
  await vi.waitFor(() => expect(listener.bytes).toHaveBeenCalled());
  expect(listener.text).toHaveBeenCalledWith('{"type":"hello"}');
  expect([...new Uint8Array(listener.bytes.mock.calls[0]![0])]).toEqual([1, 2]);
  connection.send({ type: 'touch' });
  await vi.waitFor(() => expect(heard).toEqual(['{"type":"touch"}']));
});

it('comes back to a gateway that was restarted, and loses what it said in between', async () => {
  const first = serve();
  const port = await first.port;
  const listener = listen();
  const connection = connect(port, listener);
  await vi.waitFor(() => expect(listener.opened).toHaveBeenCalledTimes(1));
  first.server.clients.forEach((client) => client.terminate());
  first.server.close();
  await vi.waitFor(() => expect(listener.closed).toHaveBeenCalled());
  connection.send({ type: 'touch' });
  const heard = vi.fn();
  serve(port).server.on('connection', (socket) => socket.on('message', heard));
  await vi.waitFor(() => expect(listener.opened).toHaveBeenCalledTimes(2), 5000);
  expect(heard).not.toHaveBeenCalled();
});

it('does not come back after its end', async () => {
  const { server, port } = serve();
  const listener = listen();
  const connection = connect(await port, listener);
  await vi.waitFor(() => expect(listener.opened).toHaveBeenCalled());
  connection.end();
  await vi.waitFor(() => expect(listener.closed).toHaveBeenCalled());
  connection.hurry();
  expect(server.clients.size).toBe(0);
});

it('waits longer and longer, ten seconds and a fifth at most', () => {
  const waits = [...Array(12).keys()].map((tries) => waitBefore(tries, 0));
  expect(waits.slice(0, 3)).toEqual([500, 1000, 2000]);
  expect(Math.max(...waits)).toBe(10_000);
  expect(waitBefore(20, 1)).toBe(12_000);
});
