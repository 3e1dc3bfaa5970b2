// SPDX-License-Identifier: MIT
// The members of a ZIP by its central directory (APPNOTE.TXT 4.3), stored or deflated, with their
// checksums verified. For tests only.
import assert from 'node:assert/strict';
import zlib from 'node:zlib';

function crc32(bytes) {
    let crc = ~0;
    for (const byte of bytes) {
        crc ^= byte;
        for (let bit = 0; bit < 8; bit += 1) {
            crc = crc & 1 ? (crc >>> 1) ^ 0xedb88320 : crc >>> 1;
        }
    }
    return ~crc >>> 0;
}

function readMember(zip, at) {
    assert.equal(zip.readUInt32LE(at), 0x02014b50, 'an entry of the directory');
    const [method, crc, packed, size] = [
        zip.readUInt16LE(at + 10),
        zip.readUInt32LE(at + 16),
        zip.readUInt32LE(at + 20),
        zip.readUInt32LE(at + 24),
    ];
    const nameLength = zip.readUInt16LE(at + 28);
    const local = zip.readUInt32LE(at + 42);
    assert.equal(zip.readUInt32LE(local), 0x04034b50, 'a local header');
    const start = local + 30 + zip.readUInt16LE(local + 26) + zip.readUInt16LE(local + 28);
    const stored = zip.subarray(start, start + packed);
    const bytes = method === 0 ? stored : zlib.inflateRawSync(stored);
    assert.equal(bytes.length, size);
    assert.equal(crc32(bytes), crc);
    return {
        name: zip.subarray(at + 46, at + 46 + nameLength).toString(),
        method,
        bytes,
        next: at + 46 + nameLength + zip.readUInt16LE(at + 30) + zip.readUInt16LE(at + 32),
    };
}

/** [{name, method, bytes}] in the order of the directory. */
export function readZip(zip) {
    const end = zip.lastIndexOf(Buffer.from('PK\x05\x06'));
    assert.ok(end >= 0, 'the end of the directory');
    const members = [];
    let at = zip.readUInt32LE(end + 16);
    for (let i = 0; i < zip.readUInt16LE(end + 10); i += 1) {
        const { next, ...member } = readMember(zip, at);
        members.push(member);
        at = next;
    }
    return members;
}
