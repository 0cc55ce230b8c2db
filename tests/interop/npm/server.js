// jsmodbus or modbus-serial as a server: unit 1 with 100 items in each table. Prints "ready", and each item that is written:
//   wrote holding 50 1234
// usage: server.js jsmodbus|modbus-serial tcp|rtu|rtu-over-tcp PORT|DEVICE
"use strict";

const net = require("net");

const SIZE = 100;
const HOST = "127.0.0.1";
const SERIAL = { baudRate: 19200, parity: "none" };

// What the tables hold in the beginning, by address: as in peer_servers.py.
const initial = {
    coils: at => at % 3 === 0 ? 1 : 0,
    discrete: at => at % 2 === 0 ? 1 : 0,
    holding: at => 1000 + at,
    input: at => 65000 + at,
};
const addresses = Array.from({ length: SIZE }, (_, at) => at);

const ready = () => console.log("ready");
const wrote = (table, at, value) => console.log(`wrote ${table} ${at} ${Number(value)}`);

function jsmodbus(framing, where) {
    const { server } = require("jsmodbus");
    const { SerialPort } = require("serialport");
    const bits = table => {
        const packed = Buffer.alloc(Math.ceil(SIZE / 8));
        addresses.forEach(at => packed[at >> 3] |= initial[table](at) << (at & 7));
        return packed;
    };
    const words = table => {
        const packed = Buffer.alloc(2 * SIZE);
        addresses.forEach(at => packed.writeUInt16BE(initial[table](at), 2 * at));
        return packed;
    };
    const tables = { coils: bits("coils"), discrete: bits("discrete"), holding: words("holding"), input: words("input") };

    const listening = modbus => {
        modbus.on("postWriteSingleCoil", ({ body }) => wrote("coils", body.address, body.value !== 0));
        modbus.on("postWriteSingleRegister", ({ body }) => wrote("holding", body.address, body.value));
        // It emits these for its buffers as well.
        modbus.on("postWriteMultipleCoils", ({ body }) => body && addresses.slice(0, body.quantity).forEach(i =>
            wrote("coils", body.address + i, body.valuesAsBuffer[i >> 3] >> (i & 7) & 1)));
        modbus.on("postWriteMultipleRegisters", ({ body }) => body && addresses.slice(0, body.quantity).forEach(i =>
            wrote("holding", body.address + i, Buffer.from(body.values).readUInt16BE(2 * i))));
    };

    if (framing === "rtu") {
        const port = new SerialPort({ path: where, ...SERIAL });
        listening(new server.RTU(port, tables));
        port.on("open", ready);
        return;
    }
    const listener = net.createServer();
    listener.on("connection", socket => socket.on("error", () => socket.destroy()));
    if (framing === "tcp")
        listening(new server.TCP(listener, tables));
    else
        listener.on("connection", socket => listening(new server.RTU(socket, tables)));
    listener.listen(Number(where), HOST, ready);
}

function modbusSerial(framing, where) {
    const { ServerTCP, ServerSerial } = require("modbus-serial");
    const tables = {};
    for (const table of Object.keys(initial))
        tables[table] = addresses.map(initial[table]);
    const existing = at => {
        if (at >= SIZE)
            throw Object.assign(new Error("no such address"), { modbusErrorCode: 2 });
        return at;
    };
    const write = table => (at, value) => {
        tables[table][existing(at)] = Number(value);
        wrote(table, at, value);
    };
    const vector = {
        getCoil: at => tables.coils[existing(at)] === 1,
        getDiscreteInput: at => tables.discrete[existing(at)] === 1,
        getHoldingRegister: at => tables.holding[existing(at)],
        getInputRegister: at => tables.input[existing(at)],
        setCoil: write("coils"),
        setRegister: write("holding"),
        readDeviceIdentification: () => ({ 0x00: "npm", 0x01: "modbus-serial", 0x02: "8", 0x05: "peer",
            0x97: "extended" }),
    };
    const server = framing === "rtu" ? new ServerSerial(vector, { port: where, unitID: 1, ...SERIAL })
        : new ServerTCP(vector, { host: HOST, port: Number(where), unitID: 1 });
    server.on("initialized", ready);
    server.on("serverError", error => { throw error; });
}

const [peer, framing, where] = process.argv.slice(2);
({ "jsmodbus": jsmodbus, "modbus-serial": modbusSerial })[peer](framing, where);
