/*---------------------------------------------------------------------------*\
  =========                 |
  \\      /  F ield         | MSDD: multiscale data-driven heat conduction
   \\    /   O peration     |       in granular media
    \\  /    A nd           | for OpenFOAM
     \\/     M anipulation  |
-------------------------------------------------------------------------------
License
    SPDX-License-Identifier: GPL-3.0-or-later

    This program is free software: you can redistribute it and/or modify it
    under the terms of the GNU General Public License as published by the Free
    Software Foundation, either version 3 of the License, or (at your option)
    any later version. It comes without any warranty: see the file LICENSE.
\*---------------------------------------------------------------------------*/

#include "wallConditions.H"
#include "nodeDyads.H"

// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

Foam::scalarField Foam::wallConstraints::positions(const scalar time) const
{
    const label dim = mesh_.dim();
    scalarField sum(dim*mesh_.size(), Zero);

    bool moving = false;
    forAll(walls_, patchi)
    {
        const wall& w = walls_[patchi];
        if (!w.holds() || !w.displacement.valid())
        {
            continue;
        }
        moving = true;
        const vector p(w.displacement().value(time));
        holding_->each(patchi, [&](label, const label i, const scalar share)
        {
            holding_->add(i, share*holding_->along(i, p.cdata()), sum);
        });
        for (const label node : mesh_.wall(patchi).nodes)
        {
            for (label k = 0; w.fixes() && k < dim; ++k)
            {
                sum[dim*node + k] += p[k]/fixing_[node];
            }
        }
    }
    return moving ? mean(sum) : sum;
}


Foam::scalarField Foam::wallConstraints::mean(scalarField& sum) const
{
    const label dim = mesh_.dim();
    scalarField result(sum.size(), Zero);
    mesh_.sum(sum);
    forAll(constrainedNodes_, i)
    {
        const label node = constrainedNodes_[i];
        for (label k = 0; k < allDirections_[i]; ++k)
        {
            const scalar* e = allBasis_.cdata() + dim*dim*i + dim*k;
            scalar along = 0;
            for (label j = 0; j < dim; ++j)
            {
                along += e[j]*sum[dim*node + j];
            }
            for (label j = 0; j < dim; ++j)
            {
                result[dim*node + j] += along/squares_[dim*i + k]*e[j];
            }
        }
    }
    return result;
}


Foam::scalarField Foam::wallConstraints::way
(
    const scalar time,
    const scalarField& u
) const
{
    return alongWalls(scalarField(positions(time) - u));
}


void Foam::wallConstraints::addPressure
(
    const scalar time,
    const scalarField& at,
    scalarField& force
) const
{
    const label dim = mesh_.dim();
    scalarField weights;
    forAll(walls_, patchi)
    {
        const wall& w = walls_[patchi];
        if (!w.presses())
        {
            continue;
        }
        // The pressure acts on the grains, against the outward normal
        const scalar p = w.pressure().value(time);
        const elementMesh::wallFaces& faces = mesh_.wall(patchi);
        for (label i = 0; i < faces.size(); ++i)
        {
            const label start = faces.start[i];
            const label count = faces.start[i + 1] - start;
            const label* nodes = faces.nodes.cdata() + start;
            weights.resize(max(weights.size(), 3*count));
            mesh_.faceWeights(at, nodes, count, weights.data());
            for (label a = 0; a < count; ++a)
            {
                for (label k = 0; k < dim; ++k)
                {
                    force[dim*nodes[a] + k] -= p*weights[dim*a + k];
                }
            }
        }
    }
}


void Foam::wallConstraints::takeAlong
(
    const across& held,
    scalarField& force,
    scalarField& along
) const
{
    const label dim = mesh_.dim();
    forAll(held.nodes, i)
    {
        const label node = held.nodes[i];
        for (label k = 0; k < held.directions[i]; ++k)
        {
            const scalar* e = held.basis.cdata() + dim*dim*i + dim*k;
            const scalar part = component(force, node, e);
            for (label j = 0; j < dim; ++j)
            {
                along[dim*node + j] += part*e[j]/held.squares[dim*i + k];
                force[dim*node + j] -= part*e[j];
            }
        }
    }
}


Foam::scalarField
Foam::wallConstraints::areas(const elementMesh::wallFaces& faces) const
{
    scalarField result(faces.size());
    scalarField weights;
    forAll(result, i)
    {
        const label start = faces.start[i];
        const label size = faces.start[i + 1] - start;
        weights.resize(max(weights.size(), 3*size));
        mesh_.faceWeights
        (
            mesh_.points(), faces.nodes.cdata() + start, size, weights.data()
        );
        vector whole(Zero);
        for (label a = 0; a < size; ++a)
        {
            whole += mesh_.vectorAt(weights, a);
        }
        result[i] = mag(whole);
    }
    return result;
}


Foam::List<Foam::vectorField> Foam::wallConditions::onFaces
(
    const List<scalarField>& stress,
    const scalarField& force
) const
{
    const label dim = mesh_.dim();
    const boolList carries
    (
        chosen
        (
            [](const wall& w)
            {
                return w.type != kind::none && w.type != kind::symmetry;
            }
        )
    );
    const smoothWalls walls(mesh_, carries);
    const across held(findAcross(walls, false));
    scalarField area(mesh_.size(), Zero);
    for (label i = 0; i < walls.size(); ++i)
    {
        area[walls.node(i)] += walls.area(i);
    }
    labelList level(mesh_.size(), Zero);
    forAll(held.nodes, i)
    {
        level[held.nodes[i]] = held.directions[i];
    }

    // First nodes of one wall, then edges, then corners: there a face has the
    // pressure of its cell and the mean shear of its other nodes, and walls take
    // the rest along their normals; what these do not span acts on all equally
    List<vectorField> result(walls_.size()), sum(walls_.size());
    List<scalarField> count(walls_.size());
    forAll(walls_, patchi)
    {
        const label faces = mesh_.wall(patchi).size();
        result[patchi].resize(faces, Zero);
        sum[patchi].resize(faces, Zero);
        count[patchi].resize(faces, Zero);
    }
    for (label now = 1; now <= dim; ++now)
    {
        const List<vectorField> sumBefore(sum);
        const List<scalarField> countBefore(count);
        const auto each = [&](auto f)
        {
            forAll(walls_, patchi)
            {
                walls.each(patchi, [&](label face, label i, scalar share)
                {
                    if (level[walls.node(i)] == now)
                    {
                        const scalar* n = walls.normal(i);
                        const label celli = mesh_.wall(patchi).cells[face];
                        scalar s[6];
                        for (label k = 0; k < 3*(dim - 1); ++k)
                        {
                            s[k] = stress[k][celli];
                        }
                        vector t
                        (
                            sumBefore[patchi][face]
                           /max(countBefore[patchi][face], scalar(1))
                        );
                        for (label k = 0; k < dim; ++k)
                        {
                            t[k] += pressureAcross(n, s)*n[k];
                        }
                        f(patchi, face, i, share*walls.area(i), t);
                    }
                });
            }
        };
        scalarField taken(force.size(), Zero), along(taken);
        each([&](label, label, label i, scalar part, const vector& t)
        {
            for (label k = 0; k < dim; ++k)
            {
                taken[dim*walls.node(i) + k] += part*t[k];
            }
        });
        mesh_.sum(taken);
        scalarField rest(force - taken);
        takeAlong(held, rest, along);
        each([&](label patchi, label face, label i, scalar part, const vector& t)
        {
            const label node = walls.node(i);
            const scalar* n = walls.normal(i);
            const scalar across = component(along, node, n)/walls.area(i);
            vector all(t), normal(Zero);
            for (label k = 0; k < dim; ++k)
            {
                normal[k] = n[k];
                all[k] += across*n[k] + rest[dim*node + k]/area[node];
            }
            result[patchi][face] += part*all;
            sum[patchi][face] += all - (all & normal)*normal;
            count[patchi][face] += 1;
        });
    }

    forAll(walls_, patchi)
    {
        if (carries[patchi])
        {
            result[patchi] /= areas(mesh_.wall(patchi));
        }
    }
    return result;
}


void Foam::wallConditions::addStick
(
    const scalarField& d,
    scalarField& force
) const
{
    const label dim = mesh_.dim();
    forEachTangentialStiffness([&](const label node, const scalar* t, const scalar k)
    {
        scalar along = 0;
        for (label j = 0; j < dim; ++j)
        {
            along += t[j]*d[dim*node + j];
        }
        for (label j = 0; j < dim; ++j)
        {
            force[dim*node + j] += k*along*t[j];
        }
    });
}


// ************************************************************************* //
