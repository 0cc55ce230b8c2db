// jsmodbus or modbus-serial as a client. Reads calls as JSON lines, and answers each with one:
//   {"call": "holding", "with": [0, 2]}  ->  {"values": [1, 2]}, {"exception": 2} or {"failed": "Timeout"}
// usage: client.js jsmodbus|modbus-serial tcp|rtu|ascii|rtu-over-tcp UNIT PORT|DEVICE
"use strict";

const net = require("net");
const readline = require("readline");

const PATIENCE = 20000;  // ms that an answer may take
const SERIAL = { baudRate: 19200, parity: "none" };

const happened = (emitter, event) => new Promise((resolve, reject) => {
    emitter.once(event, resolve);
    emitter.once("error", reject);
});

async function jsmodbus(framing, unit, where) {
    const { client } = require("jsmodbus");
    const { SerialPort } = require("serialport");
    const serial = framing === "rtu";
    const stream = serial ? new SerialPort({ path: where, ...SERIAL })
        : net.connect(Number(where), "127.0.0.1");
    const modbus = framing === "tcp" ? new client.TCP(stream, unit, PATIENCE) : new client.RTU(stream, unit, PATIENCE);
    await happened(stream, serial ? "open" : "connect");
    if (framing === "rtu-over-tcp")
        stream.emit("open");  // what its RTU client waits for
    const read = what => async (first, count) =>
        Array.from((await modbus[what](first, count)).response.body.valuesAsArray).slice(0, count);
    return {
        coils: read("readCoils"),
        discrete: read("readDiscreteInputs"),
        holding: read("readHoldingRegisters"),
        input: read("readInputRegisters"),
        write_coil: (at, value) => modbus.writeSingleCoil(at, value === 1),
        write_register: (at, value) => modbus.writeSingleRegister(at, value),
        write_coils: (first, values) => modbus.writeMultipleCoils(first, values.map(v => v === 1)),
        write_registers: (first, values) => modbus.writeMultipleRegisters(first, values),
        exception_of: error => error.err === "ModbusException" ? error.response.body.code : undefined,
    };
}

async function modbusSerial(framing, unit, where) {
    const modbus = new (require("modbus-serial"))();
    const tcp = { port: Number(where) };
    const connect = {
        "tcp": () => modbus.connectTCP("127.0.0.1", tcp),
        "rtu": () => modbus.connectRTUBuffered(where, SERIAL),
        "ascii": () => modbus.connectAsciiSerial(where, SERIAL),
        "rtu-over-tcp": () => modbus.connectTelnet("127.0.0.1", tcp),
    };
    await connect[framing]();
    modbus.setID(unit);
    modbus.setTimeout(PATIENCE);
    const read = what => async (first, count) => (await modbus[what](first, count)).data.slice(0, count).map(Number);
    return {
        coils: read("readCoils"),
        discrete: read("readDiscreteInputs"),
        holding: read("readHoldingRegisters"),
        input: read("readInputRegisters"),
        write_coil: (at, value) => modbus.writeCoil(at, value === 1),
        write_register: (at, value) => modbus.writeRegister(at, value),
        write_coils: (first, values) => modbus.writeCoils(first, values.map(v => v === 1)),
        write_registers: (first, values) => modbus.writeRegisters(first, values),
        mask: (at, and, or) => modbus.maskWriteRegister(at, and, or),
        read_write: async (first, count, at, values) =>
            (await modbus.readWriteRegisters(first, count, at, values.length, values)).data,
        server_id: async () => {
            const { serverId, running } = await modbus.reportServerID(0, 0);  // it wants two arguments, and ignores them
            return [serverId, running ? 0xFF : 0x00];
        },
        identification: async () => Object.values((await modbus.readDeviceIdentification(1, 0)).data),
        exception_of: error => error.modbusCode,
    };
}

// Values are numbers or texts; a write has none.
async function answer(modbus, { call, with: parameters }) {
    try {
        const values = await modbus[call](...parameters);
        return Array.isArray(values) ? { values } : { values: [] };
    } catch (error) {
        const exception = modbus.exception_of(error);
        return exception === undefined ? { failed: String(error.message || error.err || error) } : { exception };
    }
}

async function main([peer, framing, unit, where]) {
    const open = { "jsmodbus": jsmodbus, "modbus-serial": modbusSerial }[peer];
    const modbus = await open(framing, Number(unit), where);
    console.log(JSON.stringify({ ready: Object.keys(modbus) }));
    for await (const line of readline.createInterface({ input: process.stdin }))
        console.log(JSON.stringify(await answer(modbus, JSON.parse(line))));
    process.exit(0);
}

main(process.argv.slice(2)).catch(error => {
    console.error(error);
    process.exit(1);
});
