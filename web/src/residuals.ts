/// `y` over ascending `x` at the place `at`: a cubic through the four nearest points; nothing outside of `x`, and where
/// its neighbours are more than `widest` apart.
export function interpolated(x: number[], y: number[], at: number, widest = 12): number | null {
    const above = x.findIndex((each) => each >= at);
    if (above < 0) return null;
    if (x[above] === at) return y[above]!;
    if (above === 0 || x[above]! - x[above - 1]! > widest) return null;
    const first = Math.max(0, Math.min(above - 2, x.length - 4));
    const places = Array.from({length: Math.min(4, x.length)}, (_, k) => first + k);
    return places.reduce((sum, i) => sum + y[i]! * places.reduce(
        (product, j) => (i === j ? product : product * (at - x[j]!) / (x[i]! - x[j]!)), 1), 0);
}

/// A model minus what was measured, at the wavelengths of the measurement that the model reaches.
export function residualsOf(model: {wavelength_nm: number[]; reading: number[]}, measured: {wavelength_nm: number[]; value: number[]}) {
    const found = measured.wavelength_nm.map((nm, i) => {
        const reading = interpolated(model.wavelength_nm, model.reading, nm);
        return {nm, index: i, residual: reading === null ? null : reading - measured.value[i]!};
    }).filter((each): each is {nm: number; index: number; residual: number} => each.residual !== null);
    return {x: found.map(({nm}) => nm), y: found.map(({residual}) => residual), indices: found.map(({index}) => index)};
}
