// What the graphics card runs. All of it knows the section box, and which storeys are shown.
import { ShaderMaterial } from 'three';

const COMMON = `
  uniform vec3 low, high;
  bool cut(vec3 p) { return any(lessThan(p, low)) || any(greaterThan(p, high)); }`;
const STOREYS = `
  uniform float shown[33];
  bool hidden(float storey) { return shown[int(clamp(storey, 0.0, 32.0) + 0.5)] < 0.5; }
  const vec4 nowhere = vec4(2.0, 2.0, 2.0, 1.0);`;

const WARM = `
  vec3 warm(float s) {
    vec3 middle = vec3(0.867);
    return s < 0.0 ? mix(middle, vec3(0.231, 0.298, 0.753), -s) : mix(middle, vec3(0.706, 0.016, 0.149), s);
  }`;

/** Faces: lit, the chosen ones and those of the chosen room tinted; with the scan's distances painted on, on the chosen ones or on all. */
export function faceMaterial(uniforms, own, settings) {
  return new ShaderMaterial({
    uniforms: { ...uniforms, ...own },
    vertexShader: `
      attribute vec3 tint; attribute vec3 ids; attribute vec2 square;
      varying vec3 vTint; varying vec3 vNormal; varying vec3 vPlace; varying vec3 vIds; varying vec2 vSquare;
      ${STOREYS}
      void main() {
        vTint = tint; vNormal = normal; vPlace = position; vIds = ids; vSquare = square;
        gl_Position = hidden(ids.z) ? nowhere : projectionMatrix * modelViewMatrix * vec4(position, 1.0);
      }`,
    fragmentShader: `
      varying vec3 vTint; varying vec3 vNormal; varying vec3 vPlace; varying vec3 vIds; varying vec2 vSquare;
      uniform float opacity, face, other, room, light, heated, range; uniform sampler2D squares; uniform vec2 squaresSize;
      ${COMMON}
      ${WARM}
      bool is(float index) { return (index >= 0.0 || index < -999.0) && abs(vIds.x - index) < 0.5; }
      void main() {
        if (cut(vPlace)) discard;
        vec3 n = normalize(gl_FrontFacing ? vNormal : -vNormal);
        float shade = 0.86 + 0.07 * n.z + 0.11 * dot(n, vec3(0.53, -0.8, 0.28));
        vec3 colour = vTint * mix(1.0, shade, light);
        float alpha = opacity;
        bool chosen = is(face) || is(other);
        bool measured = vIds.x > -0.5 && vSquare.x >= 0.0;
        if (vIds.x > -0.5 && (heated > 0.5 || (chosen && measured))) {
          vec4 texel = measured ? texture2D(squares, (floor(vSquare) + 0.5) / squaresSize) : vec4(0.0);
          float distance = (texel.r * 65280.0 + texel.g * 255.0 - 32768.0) * 0.0001;
          colour = (texel.a > 0.5 ? warm(clamp(distance / range, -1.0, 1.0)) : vec3(0.62, 0.61, 0.58)) * mix(1.0, shade, 0.35);
          alpha = max(alpha, 0.92);
        }
        else if (chosen) { colour = mix(colour, vec3(0.93, 0.42, 0.05), 0.62); alpha = max(alpha, 0.85); }
        else if (room >= 0.0 && abs(vIds.y - room) < 0.5) { colour = mix(colour, vec3(0.15, 0.52, 0.87), 0.45); alpha = max(alpha, 0.7); }
        gl_FragColor = vec4(colour, alpha);
      }`,
    ...settings,
  });
}

export function lineMaterial(uniforms, own, settings) {
  return new ShaderMaterial({
    uniforms: { ...uniforms, ...own },
    vertexShader: `
      attribute float storey; varying vec3 vPlace;
      ${STOREYS}
      void main() {
        vPlace = position;
        gl_Position = hidden(storey) ? nowhere : projectionMatrix * modelViewMatrix * vec4(position, 1.0);
      }`,
    fragmentShader: `
      varying vec3 vPlace; uniform vec3 colour; uniform float opacity;
      ${COMMON}
      void main() { if (cut(vPlace)) discard; gl_FragColor = vec4(colour, opacity); }`,
    transparent: true,
    ...settings,
  });
}

/** Points: as large as they are in space; those on a face are seen from its front only. */
export function pointMaterial(uniforms, own) {
  return new ShaderMaterial({
    uniforms: { ...uniforms, ...own },
    vertexShader: `
      attribute vec3 tint; attribute vec3 facing; attribute vec3 kind;
      varying vec3 vTint;
      uniform float size, scale, least, ceilings, coloured, range, parallel; uniform vec3 eye;
      ${STOREYS}
      ${COMMON}
      ${WARM}
      void main() {
        vec3 away = parallel > 0.5 ? eye : eye - position;
        bool back = dot(facing, facing) > 0.0 && dot(facing, away) < 0.0;
        if (back || hidden(kind.x) || cut(position) || (ceilings < 0.5 && kind.y > 0.5)) { gl_Position = nowhere; gl_PointSize = 0.0; return; }
        vTint = coloured > 0.5 ? (kind.z < -127.5 ? vec3(0.36) : warm(clamp(kind.z * 0.5 / range, -1.0, 1.0))) : tint;
        gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
        gl_PointSize = clamp(size * scale / (parallel > 0.5 ? 1.0 : gl_Position.w), least, 24.0);
      }`,
    fragmentShader: `
      varying vec3 vTint;
      void main() { gl_FragColor = vec4(vTint, 1.0); }`,
  });
}
