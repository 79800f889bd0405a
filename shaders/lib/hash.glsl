// SPDX-License-Identifier: MIT
// Integer hashes: every random choice is one of these over what it depends on.

// A permutation of the 32-bit integers: xor-shifts and multiplications by odd numbers, each of
// which can be undone. The multipliers are those found by C. Wellons' search for low bias.
uint mixBits(uint x) {
    x ^= x >> 16;
    x *= 0x7feb352du;
    x ^= x >> 15;
    x *= 0x846ca68bu;
    x ^= x >> 16;
    return x;
}

// unmixBits(mixBits(x)) = x.
uint unmixBits(uint x) {
    x ^= x >> 16;
    x *= 0x43021123u; // the inverse of 0x846ca68b modulo 2^32
    x ^= (x >> 15) ^ (x >> 30);
    x *= 0x1d69e2a5u; // the inverse of 0x7feb352d modulo 2^32
    x ^= x >> 16;
    return x;
}

uint hash2(uint a, uint b) {
    return mixBits(a ^ mixBits(b + 0x9e3779b9u));
}

uint hash3(uint a, uint b, uint c) {
    return hash2(a, hash2(b, c));
}
