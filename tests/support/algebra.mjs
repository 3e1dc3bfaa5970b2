// SPDX-License-Identifier: MIT
// The process of the algebra that a daemon has started.
import fs from 'node:fs';

export const isAlgebra = (pid) => {
    try {
        return fs.readFileSync(`/proc/${pid}/cmdline`, 'utf8').split('\0')[0].endsWith('fieldcast-algebra');
    } catch {
        return false;
    }
};

export function algebraOf(daemon) {
    const threads = fs.readdirSync(`/proc/${daemon.pid}/task`);
    const children = threads.flatMap((id) => fs.readFileSync(`/proc/${daemon.pid}/task/${id}/children`, 'utf8').split(' '));
    return children.filter((pid) => pid && isAlgebra(pid));
}
